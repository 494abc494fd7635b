"""similaritymeasures: the measures of Jekel et al. (2018), by their first author."""

import similaritymeasures as package

PACKAGE = "similaritymeasures"
LICENCE = "MIT"
CHECKS = {
    "frechet": package.frechet_dist,
    "area": package.area_between_two_curves,
    "dtw": lambda P, Q: package.dtw(P, Q)[0],
    "dtw-squared": lambda P, Q: package.dtw(P, Q, metric="sqeuclidean")[0],
}
NOTES = {"area": "the middle of an upright piece is one of its ends, by an interpolation in x"}
