/// \file
/// Measures of the similarity of two curves: everything that curvewise offers to C++, except the
/// Eigen adaptors.
#pragma once

#include "curvewise/attempt.hpp"
#include "curvewise/block_distances.hpp"
#include "curvewise/build_info.hpp"
#include "curvewise/closed_curves.hpp"
#include "curvewise/common_part.hpp"
#include "curvewise/compare.hpp"
#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/dtw_mean.hpp"
#include "curvewise/gradient.hpp"
#include "curvewise/lower_bounds.hpp"
#include "curvewise/materials.hpp"
#include "curvewise/matrix_profile.hpp"
#include "curvewise/measure.hpp"  // and all measures
#include "curvewise/nearest.hpp"
#include "curvewise/options.hpp"
#include "curvewise/pairwise.hpp"
#include "curvewise/pointwise.hpp"
#include "curvewise/simplify.hpp"
#include "curvewise/soft_dtw.hpp"
#include "curvewise/subsequence.hpp"
#include "curvewise/version.hpp"
