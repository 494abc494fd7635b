"""curvesimilarities: Fréchet distances, discrete and continuous, and dtw."""

import curvesimilarities as package

PACKAGE = "curvesimilarities"
LICENCE = "MIT"
CHECKS = {
    "frechet": package.dfd,
    "frechet-continuous": package.fd,
    "dtw": package.dtw,
    "dtw-squared": lambda P, Q: package.dtw(P, Q, dist="squared_euclidean"),
}
NOTES = {"dtw-squared": "the first column of its table is not squared"}
