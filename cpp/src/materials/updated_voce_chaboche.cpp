// The updated Voce-Chaboche material: the Chaboche-Voce point with a second term of isotropic
// hardening, which falls to -D at the rate a.
#include <cstddef>
#include <vector>

#include "materials/chaboche_voce.hpp"
#include "materials/law.inl.hpp"

namespace curvewise::materials {
namespace {

enum : std::size_t { YIELD = 1, Q, B, D, A, BACK };  // places of the parameters

ChabocheVoce without_fall(const UpdatedVoceChaboche& material) { return {material.backstresses}; }

template <class Number>
class UpdatedVoceChabochePoint : public SaturatingPoint<Number, 2> {
   public:
    UpdatedVoceChabochePoint(const UpdatedVoceChaboche& /*material*/, const Number* parameters,
                             std::size_t count)
        : UpdatedVoceChabochePoint(limits({parameters, parameters + count})) {}

   private:
    explicit UpdatedVoceChabochePoint(const std::vector<Number>& parameters)
        : SaturatingPoint<Number, 2>(Modulus::constant, parameters.data(), parameters.size()) {}

    static std::vector<Number> limits(std::vector<Number> parameters) {
        parameters[D] = -parameters[D];
        return parameters;
    }
};

}  // namespace

template <>
struct Law<UpdatedVoceChaboche> {
    template <class Number>
    using Point = UpdatedVoceChabochePoint<Number>;

    static std::vector<MaterialParameter> parameters(const UpdatedVoceChaboche& material) {
        auto found = Law<ChabocheVoce>::parameters(without_fall(material));
        found[Q].meaning = "final increase of the yield stress, without its fall";
        const std::vector<MaterialParameter> fall{
            {"D", "stress", "final fall of the yield stress"},
            {"a", "-", "rate of this fall with the plastic strain"}};
        found.insert(found.begin() + D, fall.begin(), fall.end());
        return found;
    }
    static void check(const UpdatedVoceChaboche& /*material*/, const Parameters& given) {
        given.above_zero(0);
        given.above_zero(YIELD);
        for (std::size_t i = Q; i < given.count(); ++i) given.at_least_zero(i);
        if (given[D] >= given[YIELD]) {
            given.refuse(D, "a yield stress of " + text_of(given[YIELD]) +
                                " would soften to nothing; give D < yield");
        }
    }
    static double largest_stress(const UpdatedVoceChaboche& /*material*/, const Parameters& checked,
                                 const StrainPath& /*path*/) {
        double most = checked[YIELD] + checked[Q];
        for (std::size_t i = BACK; i < checked.count(); i += 2) {
            if (checked[i] > 0.0) most += checked[i] / checked[i + 1];
        }
        return with_rounding(most, 1e-9);
    }
};

template struct ByStrain<UpdatedVoceChaboche>;
template struct ByStress<UpdatedVoceChaboche>;

}  // namespace curvewise::materials
