/* A finite-element post-processor: the history of a run against the record of a test. It prints all
 * measures, and the increment that is farthest from the test. */
#include <curvewise/curvewise.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { increments = 129, samples = 65 };

/* As the solver writes an increment. */
typedef struct increment {
    double time, displacement, force, energy;
} increment;

static void simulate(increment* run) {
    int i;
    for (i = 0; i < increments; ++i) {
        const double t = i / (increments - 1.0), u = 4.0 * t * (1.0 - t);
        run[i].time = t;
        run[i].displacement = u;
        run[i].force = 300.0 * u * (1.0 - 0.25 * u) + (t > 0.5 ? -40.0 : 40.0);
        run[i].energy = 0.0;
    }
}

/* Column by column: displacements, then forces. */
static void measure(double* test) {
    int j;
    for (j = 0; j < samples; ++j) {
        const double t = j / (samples - 1.0), u = 4.0 * t * (1.0 - t);
        test[j] = u;
        test[samples + j] = 312.0 * u * (1.0 - 0.25 * u) + (t > 0.5 ? -44.0 : 44.0);
    }
}

static double at(const curvewise_curve* curve, int64_t i, int c) {
    return curve->data[(ptrdiff_t)i * curve->row_stride + c * curve->col_stride];
}

static int fail(const curvewise_error* error) {
    fprintf(stderr, "post_processor: %s\n", error->message);
    return EXIT_FAILURE;
}

int main(void) {
    static increment run[increments];
    static double test[2 * samples];
    static int64_t path[2 * (increments + samples - 1)];
    curvewise_comparison found = CURVEWISE_COMPARISON;
    curvewise_curve P, Q;
    curvewise_error error;
    double distance, farthest = -1.0;
    ptrdiff_t count, k, worst = 0;

    simulate(run);
    measure(test);
    P.data = test, P.n = samples, P.dim = 2, P.row_stride = 1, P.col_stride = samples;
    Q.data = &run[0].displacement, Q.n = increments, Q.dim = 2;
    Q.row_stride = sizeof *run / sizeof(double), Q.col_stride = 1;

    if (curvewise_compare(&P, &Q, NULL, &found, &error) != CURVEWISE_OK) return fail(&error);
    printf("area %.17g\npcm %.17g\nfrechet %.17g\n", found.area, found.pcm, found.frechet);
    printf("dtw %.17g\ncurve_length %.17g\n", found.dtw, found.curve_length);

    if (curvewise_dtw_path(&P, &Q, NULL, &distance, path, increments + samples - 1, &count,
                           &error) != CURVEWISE_OK) {
        return fail(&error);
    }
    for (k = 0; k < count; ++k) {
        const double gap = fabs(at(&P, path[2 * k], 1) - at(&Q, path[2 * k + 1], 1));
        if (gap > farthest) farthest = gap, worst = (ptrdiff_t)path[2 * k + 1];
    }
    printf("increment %d\nforce_gap %.17g\n", (int)worst, farthest);
    return EXIT_SUCCESS;
}
