// Any material of the list: by the type of its options, and by a text that names them.
#include "curvewise/materials.hpp"

#include <charconv>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "materials/law.hpp"

namespace curvewise {
namespace {

using Word = std::pair<std::string, std::string>;  // an option and its value

std::string quoted(const std::string& text) { return "'" + text + "'"; }

[[noreturn]] void refuse(const std::string& what, const std::string& known) {
    throw std::invalid_argument("unknown " + what + "; choose from " + known);
}

void append(std::string& list, const char* name) {
    list += (list.empty() ? "" : ", ") + std::string(name);
}

// Takes the options of a material from the words of a text.
class OptionReader {
   public:
    explicit OptionReader(std::vector<Word> words) : words_(std::move(words)) {}

    template <class Value>
    void operator()(const char* name, Value& value) {
        append(known_, name);
        for (auto word = words_.begin(); word != words_.end(); ++word) {
            if (word->first != name) continue;
            read(name, word->second, value);
            words_.erase(word);
            return;
        }
    }
    // Throws if words are left.
    void end(const char* material) const {
        if (words_.empty()) return;
        refuse("option " + quoted(words_.front().first) + " of " + material,
               known_.empty() ? "none" : known_);
    }

   private:
    template <class Enum>
    static std::enable_if_t<std::is_enum_v<Enum>> read(const char* name, const std::string& text,
                                                       Enum& value) {
        constexpr auto names = choice_names(Enum{});
        std::string known;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (text == names[i]) {
                value = static_cast<Enum>(i);
                return;
            }
            append(known, names[i]);
        }
        refuse(name + (" " + quoted(text)), known);
    }
    static void read(const char* name, const std::string& text, int& value) {
        const char* const end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && last == end) return;
        throw std::invalid_argument(name + (" is " + text) + "; give a whole number");
    }
    static void read(const char* name, const std::string& text, double& value) {
        std::istringstream stream(text);
        stream.imbue(std::locale::classic());
        if (stream >> value && stream.peek() == std::istringstream::traits_type::eof()) return;
        throw std::invalid_argument(name + (" is " + text) + "; give a number");
    }

    std::vector<Word> words_;
    std::string known_;
};

}  // namespace

Material material_from(std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string name, word, known;
    words >> name;
    std::vector<Word> options;
    while (words >> word) {
        const std::size_t place = word.find('=');
        const bool has_value = place != std::string::npos;
        options.emplace_back(word.substr(0, place), has_value ? word.substr(place + 1) : "");
    }
    std::optional<Material> found;
    for_each_material([&](auto material) {
        append(known, material.material);
        if (name != material.material) return;
        OptionReader reader(options);
        visit_options(material, reader);
        reader.end(material.material);
        found = material;
    });
    if (!found) refuse("material " + quoted(name), known);
    return *found;
}

std::vector<MaterialParameter> material_parameters(const Material& material) {
    return std::visit(
        [](const auto& one) {
            return materials::ByStrain<std::decay_t<decltype(one)>>::parameters(one);
        },
        material);
}

void material_stress(const Material& material, const double* parameters, const double* strain,
                     std::ptrdiff_t n, double* stress, double* slopes, Control* control) {
    std::visit(
        [&](const auto& one) {
            materials::ByStrain<std::decay_t<decltype(one)>>::stress(one, parameters, strain, n,
                                                                     stress, slopes, control);
        },
        material);
}

void material_response(const Material& material, const double* parameters, const double* given,
                       const bool* by_stress, std::ptrdiff_t n, double* answer, double* slopes,
                       Control* control) {
    std::visit(
        [&](const auto& one) {
            materials::ByStress<std::decay_t<decltype(one)>>::response(
                one, parameters, given, by_stress, n, answer, slopes, control);
        },
        material);
}

}  // namespace curvewise
