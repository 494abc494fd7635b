/// \file
/// Material points: the stress along a path of strain, and its derivatives by every parameter, for
/// models whose parameters are identified from loops. The models are uniaxial, driven by strain or
/// by stress, independent of their rate, and unloaded at the start. The strain runs monotonically
/// from each value to the next.
///
/// ChabocheVoce: back stresses X_k and a yield stress that grows or shrinks,
///
///     |s - sum X_k| <= yield + Q (1 - exp(-b p)),    dX_k = C_k de_p - gamma_k X_k dp
///
/// (Chaboche, Int. J. Plasticity 2, 1986; factors of 2/3 and 3/2 absorbed into the constants). In
/// one direction of flow, everything is a closed form of the plastic strain p. A step is one
/// equation for p, which a safeguarded Newton iteration solves. It is exact for steps of any
/// length.
///
/// YoshidaUemori: a yield surface of constant size that moves inside a bounding surface. The
/// bounding surface moves, and grows except while its centre stays within the stagnation surface
/// (Yoshida & Uemori, Int. J. Plasticity 18, 2002; uniaxial, with the constants of *MAT_125 of
/// LS-DYNA). Equations without a closed form are integrated to a stated tolerance.
///
/// Swift: isotropic hardening by a power law, |s| <= K (e0 + p)^n (Swift, J. Mechanics and Physics
/// of Solids 1, 1952). Exact for steps of any length.
///
/// UpdatedVoceChaboche: ChabocheVoce with a second isotropic term, - D (1 - exp(-a p)), for steels
/// whose yield stress first falls (Hartloper, de Castro e Sousa & Lignos, J. Structural Engineering
/// 147, 2021). Exact for steps of any length.
///
/// JohnsonCook: isotropic hardening at a rate of strain, |s| <= (A + B p^n) (1 + C ln(rate /
/// reference_rate)) (Johnson & Cook, 7th International Symposium on Ballistics, 1983). Exact for
/// steps of any length.
///
/// OhnoWang: back stresses X_k with a recall that acts near their limits r_k, and a yield stress as
/// that of ChabocheVoce,
///
///     dX_k = zeta_k (r_k de_p - (|X_k| / r_k)^m_k X_k <dp sign(X_k de_p)>)
///
/// (Ohno & Wang, Int. J. Plasticity 9, 1993, version II; factors of 2/3 and 3/2 absorbed into the
/// constants). Ratchets less than ChabocheVoce. Exact for steps of any length.
///
/// Young's modulus of the first two is constant or decays with the plastic strain (Yoshida, Uemori
/// & Fujiwara, Int. J. Plasticity 18, 2002): ds = E(p) de_e with E(p) = E - (E - Ea)(1 - exp(-xi
/// p)).
///
/// Derivatives are those of the computed stress, by dual numbers in the same pass. A step that just
/// reaches the yield surface has a kink; the derivatives there are those of one side.
///
/// Time O(n) (k/8 times that for derivatives by k parameters), memory O(1). Throws
/// std::invalid_argument for invalid strains and parameters, with their names. Strains and
/// parameters are invalid if they are not finite or out of range. Parameters are also invalid if
/// the stress leaves the range of the law or a derivative is not finite. Throws Stopped. Safe from
/// any number of threads.
///
///     curvewise::ChabocheVoce steel;                       // two back stresses
///     const double parameters[] = {200e3, 300, -50, 8, 80e3, 400, 5e3, 20};
///     std::vector<double> stress(strain.size()), slopes(8 * strain.size());
///     curvewise::material_stress(steel, parameters, strain.data(), strain.size(), stress.data(),
///                                slopes.data());
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// The change of Young's modulus while plastic strain accumulates.
enum class Modulus {
    constant,  ///< parameter E
    decaying   ///< parameters E, Ea (its limit) and xi (the rate)
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(Modulus /*modulus*/) noexcept {
    return names_up_to<Modulus::decaying>("constant", "decaying");
}

/// How the bounding surface grows with the plastic strain p.
enum class BoundGrowth {
    saturating,  ///< dR = K (RSAT - R) dp
    power        ///< R = RSAT ((C1 + p)^C2 - C1^C2): two parameters more
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(BoundGrowth /*growth*/) noexcept {
    return names_up_to<BoundGrowth::power>("saturating", "power");
}

/// Parameters, in order: E (Ea, xi), yield, Q, b, then C1, gamma1, C2, gamma2, ...
struct ChabocheVoce {
    static constexpr const char* material = "chaboche-voce";
    int backstresses = 2;  ///< 0 to 99
    Modulus modulus = Modulus::constant;
};

/// Parameters, in order: E (Ea, xi), CB, Y, C, K, RSAT, SB, H (C1, C2).
struct YoshidaUemori {
    static constexpr const char* material = "yoshida-uemori";
    BoundGrowth growth = BoundGrowth::saturating;
    Modulus modulus = Modulus::constant;
    /// The error that the integration may make, relative to CB. 1e-12 to 1e-3.
    double rtol = 1e-9;
};

/// Parameters, in order: E, K, e0, n.
struct Swift {
    static constexpr const char* material = "swift";
};

/// Parameters, in order: E, A, B, n, C.
struct JohnsonCook {
    static constexpr const char* material = "johnson-cook";
    double rate = 1.0;            ///< of strain, in the unit of reference_rate
    double reference_rate = 1.0;  ///< at which C has no effect
};

/// Parameters, in order: E, yield, Q, b, D, a, then C1, gamma1, C2, gamma2, ...
struct UpdatedVoceChaboche {
    static constexpr const char* material = "updated-voce-chaboche";
    int backstresses = 2;  ///< 0 to 99
};

/// Parameters, in order: E, yield, Q, b, then zeta1, r1, m1, zeta2, r2, m2, ...
struct OhnoWang {
    static constexpr const char* material = "ohno-wang";
    int backstresses = 2;  ///< 0 to 99
};

/// Calls visit(name, value) for each option.
template <class Visit>
void visit_options(ChabocheVoce& material, Visit&& visit) {
    visit("backstresses", material.backstresses);
    visit("modulus", material.modulus);
}
template <class Visit>
void visit_options(YoshidaUemori& material, Visit&& visit) {
    visit("growth", material.growth);
    visit("modulus", material.modulus);
    visit("rtol", material.rtol);
}

template <class Visit>
void visit_options(OhnoWang& material, Visit&& visit) {
    visit("backstresses", material.backstresses);
}
template <class Visit>
void visit_options(UpdatedVoceChaboche& material, Visit&& visit) {
    visit("backstresses", material.backstresses);
}
template <class Visit>
void visit_options(JohnsonCook& material, Visit&& visit) {
    visit("rate", material.rate);
    visit("reference_rate", material.reference_rate);
}
template <class Visit>
void visit_options(Swift& /*material*/, Visit&& /*visit*/) {}

/// The list of materials: one of them, chosen by the type of its options. C, Fortran and Python
/// have every material that is added here.
using Material =
    std::variant<ChabocheVoce, YoshidaUemori, Swift, JohnsonCook, UpdatedVoceChaboche, OhnoWang>;

/// Calls visit(material), with the default options of every material in the order of the list.
template <std::size_t place = 0, class Visit>
void for_each_material(Visit&& visit) {
    if constexpr (place < std::variant_size_v<Material>) {
        visit(std::variant_alternative_t<place, Material>{});
        for_each_material<place + 1>(visit);
    }
}

/// The material that a text names, with options after it: "chaboche-voce", or "yoshida-uemori
/// growth=power rtol=1e-6". Options that are not named have their defaults. Throws
/// std::invalid_argument with the known names and values.
[[nodiscard]] CURVEWISE_EXPORT Material material_from(std::string_view text);

/// One parameter of a material. Units of stress are those of the caller.
struct MaterialParameter {
    std::string name;
    std::string unit;  ///< "stress" or "-"
    std::string meaning;
};

/// The parameters of a material, in the order of material_stress().
[[nodiscard]] CURVEWISE_EXPORT std::vector<MaterialParameter> material_parameters(
    const Material& material);

/// Writes the stress at each of n strains. Unless `slopes` is null, also writes the derivative of
/// stress i by parameter j to slopes[i * k + j], in n rows of k numbers for k parameters.
CURVEWISE_EXPORT void material_stress(const Material& material, const double* parameters,
                                      const double* strain, std::ptrdiff_t n, double* stress,
                                      double* slopes = nullptr, Control* control = nullptr);

/// Writes the response of a material to a path that gives the stress at some points and the strain
/// at the others: answer[i] is the strain where by_stress[i] is true and given[i] is a stress, and
/// the stress elsewhere. `slopes` are as those of material_stress(), of the answers. A stress is
/// reached by the first strain that a search finds, for materials that harden by the only one.
/// Throws std::invalid_argument too if hardening ends before a stress. About ten times the time of
/// material_stress().
CURVEWISE_EXPORT void material_response(const Material& material, const double* parameters,
                                        const double* given, const bool* by_stress,
                                        std::ptrdiff_t n, double* answer, double* slopes = nullptr,
                                        Control* control = nullptr);

}  // namespace curvewise
