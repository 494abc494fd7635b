/// \file
/// Step patterns: the steps of a warping path, and the weight of each cell that a step visits. A
/// pattern is one row of `step_patterns`: its steps, written as the moves that make them up, and
/// the weighting of moves. The names are those of R's dtw (Giorgino 2009). The sets of steps have
/// five sources: Sakoe & Chiba (1978, slope constraints P = 0 to 2); Myers, Rabiner & Rosenberg
/// (1980, types I to IV); Rabiner & Juang ("Fundamentals of Speech Recognition", 1993, section 4.7,
/// their types I to VII and weights a to d); Itakura, within type III; Mori et al. (2006).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "curvewise/export.h"
#include "curvewise/recurrence.hpp"

namespace curvewise {

/// How much a move of some rows and columns weighs: Rabiner & Juang's a, b, c and d.
enum class SlopeWeight { shorter, longer, rows, sum };

/// The names of the enumerators, in their order.
constexpr auto choice_names(SlopeWeight /*weight*/) noexcept {
    return names_up_to<SlopeWeight::sum>("a", "b", "c", "d");
}

/// Steps by blanks between them; a step by its moves, each by two digits: its rows and its columns.
struct StepSet {
    const char* name;
    const char* steps;
    SlopeWeight weight;
    bool smoothed = false;          ///< all moves of a step weigh as much as they do on average
    const char* weights = nullptr;  ///< in place of both, a digit for each move
    Per per = Per::one;             ///< of such a pattern; else n + m by `sum`, n by `rows`
};

inline constexpr StepSet step_patterns[] = {
    {"symmetric1", "11 10 01", SlopeWeight::longer},
    {"symmetric2", "11 10 01", SlopeWeight::sum},
    {"asymmetric", "10 11 12", SlopeWeight::rows},
    {"symmetricP0", "11 10 01", SlopeWeight::sum},
    {"symmetricP05", "110101 1101 11 1110 111010", SlopeWeight::sum},
    {"symmetricP1", "1101 11 1110", SlopeWeight::sum},
    {"symmetricP2", "111101 11 111110", SlopeWeight::sum},
    {"asymmetricP0", "01 11 10", SlopeWeight::rows},
    {"asymmetricP05", "110101 1101 11 1110 111010", SlopeWeight::rows, true},
    {"asymmetricP1", "1101 11 1110", SlopeWeight::rows, true},
    {"asymmetricP2", "111101 11 111110", SlopeWeight::rows, true},
    {"typeIa", "1110 11 1101", SlopeWeight::shorter},
    {"typeIb", "1110 11 1101", SlopeWeight::longer},
    {"typeIc", "1110 11 1101", SlopeWeight::rows},
    {"typeId", "1110 11 1101", SlopeWeight::sum},
    {"typeIas", "1110 11 1101", SlopeWeight::shorter, true},
    {"typeIbs", "1110 11 1101", SlopeWeight::longer, true},
    {"typeIcs", "1110 11 1101", SlopeWeight::rows, true},
    {"typeIds", "1110 11 1101", SlopeWeight::sum, true},
    {"typeIIa", "11 12 21", SlopeWeight::shorter},
    {"typeIIb", "11 12 21", SlopeWeight::longer},
    {"typeIIc", "11 12 21", SlopeWeight::rows},
    {"typeIId", "11 12 21", SlopeWeight::sum},
    {"typeIIIc", "12 11 1110 1210", SlopeWeight::rows},
    {"typeIVc", "11 12 13 1110 1210 1310 111010 121010 131010", SlopeWeight::rows},
    {"rigid", "11", SlopeWeight::rows},
    {"mori2006", "1110 11 1101", SlopeWeight::sum, false, "21 3 33", Per::columns},
};

/// One of `step_patterns`, in their order.
enum class StepPattern {
    symmetric1,
    symmetric2,
    asymmetric,
    symmetricP0,
    symmetricP05,
    symmetricP1,
    symmetricP2,
    asymmetricP0,
    asymmetricP05,
    asymmetricP1,
    asymmetricP2,
    typeIa,
    typeIb,
    typeIc,
    typeId,
    typeIas,
    typeIbs,
    typeIcs,
    typeIds,
    typeIIa,
    typeIIb,
    typeIIc,
    typeIId,
    typeIIIc,
    typeIVc,
    rigid,
    mori2006
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(StepPattern /*pattern*/) noexcept {
    constexpr std::size_t count = std::size(step_patterns);
    static_assert(static_cast<std::size_t>(StepPattern::mori2006) + 1 == count, "one row each");
    std::array<const char*, count> names{};
    for (std::size_t i = 0; i < count; ++i) names[i] = step_patterns[i].name;
    return names;
}

/// A line of a pattern in R's notation: a cell that step `step` visits, given by the rows and
/// columns behind the step's end. A weight of -1 marks where the step begins.
struct StepRow {
    int step = 0;
    int rows = 0;
    int columns = 0;
    double weight = 0.0;
};

constexpr double weight_of_move(int rows, int columns, SlopeWeight weight) noexcept {
    switch (weight) {
        case SlopeWeight::shorter:
            return rows < columns ? rows : columns;
        case SlopeWeight::longer:
            return rows > columns ? rows : columns;
        case SlopeWeight::rows:
            return rows;
        case SlopeWeight::sum:
            break;
    }
    return rows + columns;
}

/// The rows of a set, as its text says; at compile time too, for the kernels.
struct ParsedSteps {
    StepRow rows[48] = {};
    int count = 0;
};
constexpr ParsedSteps parsed(const StepSet& set) noexcept {
    ParsedSteps result;
    const char* weight = set.weights;
    int step = 1;
    for (const char* at = set.steps; *at != '\0'; ++step) {
        const int first = result.count++;
        int rows = 0, columns = 0, moves = 0;
        double sum = 0.0;
        for (const char* move = at; *move != ' ' && *move != '\0'; move += 2) {
            rows += move[0] - '0';
            columns += move[1] - '0';
        }
        result.rows[first] = {step, rows, columns, -1.0};
        for (; *at != ' ' && *at != '\0'; at += 2, ++moves) {
            const int down = at[0] - '0', across = at[1] - '0';
            const double own =
                weight != nullptr ? *weight++ - '0' : weight_of_move(down, across, set.weight);
            rows -= down;
            columns -= across;
            sum += own;
            result.rows[result.count++] = {step, rows, columns, own};
        }
        for (int i = first + 1; set.smoothed && i < result.count; ++i) {
            result.rows[i].weight = sum / moves;
        }
        if (*at == ' ') ++at;
        if (weight != nullptr && *weight == ' ') ++weight;
    }
    return result;
}

/// A pattern in R's notation; a custom pattern may have any rows.
struct StepRows {
    std::vector<StepRow> rows;
    Per per = Per::one;  ///< `one` if paths have different weights

    /// Whether a cell has a negative weight; distances may then be below 0.
    [[nodiscard]] CURVEWISE_EXPORT bool has_negative_weight() const noexcept;
};

[[nodiscard]] CURVEWISE_EXPORT StepRows step_rows(const StepSet& pattern);
/// Type 1 to 7 of Rabiner & Juang. Throws std::invalid_argument for another.
[[nodiscard]] CURVEWISE_EXPORT StepRows rabiner_juang(int type, SlopeWeight weight, bool smoothed);
/// Throws std::invalid_argument for a step that does not begin with a row of weight -1.
[[nodiscard]] CURVEWISE_EXPORT std::vector<Step> steps_of(const StepRows& pattern);

}  // namespace curvewise
