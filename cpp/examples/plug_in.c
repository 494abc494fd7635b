/* A plug-in that scores signals against a reference: the host keeps the handle, and may call
 * score() on many threads. main() stands for the host. */
#include <curvewise/curvewise.h>
#include <stdio.h>
#include <stdlib.h>

/* What the host of plug-ins defines. */
typedef struct plug_in {
    void* (*open)(const double* reference, int count);
    int (*score)(const void* handle, const double* signal, int count, double limit, double* score);
    void (*close)(void* handle);
} plug_in;

static curvewise_curve series(const double* values, int count) {
    return curvewise_rows(values, count, 1);
}

/* The handle is the prepared reference, which has its own copy of the values. */
static void* open_reference(const double* reference, int count) {
    curvewise_dtw_options options = CURVEWISE_DTW_DEFAULTS;
    curvewise_prepared* prepared = NULL;
    const curvewise_curve curve = series(reference, count);
    curvewise_error error;
    options.step_pattern = CURVEWISE_SYMMETRIC2;
    options.normalize = 1; /* per step, so that signals of any length compare */
    if (curvewise_prepared_create(&curve, CURVEWISE_DTW, &options, &prepared, &error) !=
        CURVEWISE_OK) {
        fprintf(stderr, "plug_in: %s\n", error.message);
    }
    return prepared;
}

/* Scores above the limit are infinity, which takes less time. Returns 0 after an error, which it
 * prints. */
static int score_signal(const void* handle, const double* signal, int count, double limit,
                        double* score) {
    curvewise_batch_options options = CURVEWISE_BATCH_DEFAULTS;
    const curvewise_curve curve = series(signal, count);
    curvewise_error error;
    options.cutoff = limit;
    if (curvewise_prepared_value(handle, &curve, &options, score, &error) == CURVEWISE_OK) return 1;
    printf("refused: %s\n", error.message);
    return 0;
}

static void close_reference(void* handle) { curvewise_prepared_destroy(handle); }

static const plug_in curvewise_plug_in = {open_reference, score_signal, close_reference};

int main(void) {
    const plug_in* const used = &curvewise_plug_in;
    const double reference[] = {0, 1, 4, 9, 4, 1, 0};
    const double late[] = {0, 0, 0, 1, 4, 9, 4, 1, 0}, weak[] = {0, 1, 3, 7, 3, 1}, flat[] = {5, 5};
    double score = 0.0;
    void* const handle = used->open(reference, 7);
    if (handle == NULL) return EXIT_FAILURE;

    if (used->score(handle, late, 9, 1.0, &score)) printf("late %.17g\n", score);
    if (used->score(handle, weak, 6, 1.0, &score)) printf("weak %.17g\n", score);
    if (used->score(handle, flat, 2, 1.0, &score)) printf("flat %.17g\n", score);
    used->score(handle, weak, 0, 1.0, &score);
    used->close(handle);
    return EXIT_SUCCESS;
}
