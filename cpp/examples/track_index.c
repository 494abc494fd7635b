/* An index in C: the nearest tracks, all tracks within a radius, and tracks that come and go. */
#include <curvewise/curvewise.h>
#include <stdio.h>
#include <stdlib.h>

enum { tracks = 40, points = 24 };

static void make(double* xy, int number, double shift) {
    int i;
    for (i = 0; i < points; ++i) {
        xy[2 * i] = i;
        xy[2 * i + 1] = number + (i * number % 7) / 8.0 + shift;
    }
}

/* Prints the tracks within a radius. Their number is not known: the first call counts them. */
static int print_within(const curvewise_index* index, const curvewise_curve* probe, double radius,
                        curvewise_error* error) {
    ptrdiff_t starts[2], k;
    int64_t* places;
    double* distances;
    int status = curvewise_index_radius_neighbors(index, probe, 1, radius, NULL, starts, NULL, NULL,
                                                  0, error);
    if (status != CURVEWISE_OK) return status;
    places = malloc((size_t)(starts[1] + 1) * sizeof *places);
    distances = malloc((size_t)(starts[1] + 1) * sizeof *distances);
    if (places != NULL && distances != NULL) {
        status = curvewise_index_radius_neighbors(index, probe, 1, radius, NULL, starts, distances,
                                                  places, starts[1], error);
        for (k = 0; status == CURVEWISE_OK && k < starts[1]; ++k) {
            printf("within %d: %d %.17g\n", (int)radius, (int)places[k], distances[k]);
        }
    }
    free(places);
    free(distances);
    return status;
}

int main(void) {
    static double xy[tracks][2 * points], asked[2 * points];
    curvewise_curve list[tracks], probe;
    curvewise_frechet_options options = CURVEWISE_FRECHET_DEFAULTS;
    curvewise_index* index = NULL;
    curvewise_error error;
    double distances[3];
    int64_t nearest[3];
    int status, k;

    for (k = 0; k < tracks; ++k) {
        make(xy[k], k, 0.0);
        list[k] = curvewise_rows(xy[k], points, 2);
    }
    make(asked, 20, 0.25);
    probe = curvewise_rows(asked, points, 2);
    options.metric = CURVEWISE_CHEBYSHEV;

    status =
        curvewise_index_create(list, tracks / 2, CURVEWISE_FRECHET, &options, NULL, &index, &error);
    if (status == CURVEWISE_OK) {
        status = curvewise_index_add(index, list + tracks / 2, tracks / 2, NULL, &error);
    }
    if (status == CURVEWISE_OK) {
        status = curvewise_index_kneighbors(index, &probe, 1, 3, NULL, distances, nearest, &error);
    }
    for (k = 0; status == CURVEWISE_OK && k < 3; ++k) {
        printf("nearest %d %.17g\n", (int)nearest[k], distances[k]);
    }
    if (status == CURVEWISE_OK) status = curvewise_index_remove(index, nearest, 1, &error);
    if (status == CURVEWISE_OK) status = print_within(index, &probe, 2.0, &error);
    printf("tracks %d\n", (int)curvewise_index_size(index));
    if (status != CURVEWISE_OK) fprintf(stderr, "track_index: %s\n", error.message);
    curvewise_index_destroy(index);
    return status;
}
