// The responses of materials to paths that give strains or stresses. Those of laws whose points are
// large stand apart from their stresses, so that the compiler inlines the points there as if this
// did not exist: in one file they made the stresses take 8 % more instructions.
#include "materials/chaboche_voce.hpp"
#include "materials/law.inl.hpp"
#include "materials/yoshida_uemori.hpp"

namespace curvewise::materials {

template struct ByStress<ChabocheVoce>;
template struct ByStress<YoshidaUemori>;

}  // namespace curvewise::materials
