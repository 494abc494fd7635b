/* The five measures of two loops from C99, a batch, a material, and what an error looks like. */
#include <curvewise/curvewise.h>
#include <stdio.h>

enum { n = 129, m = 65 };

/* A closed loop: x a triangle wave, y a parabola on each branch; x0, y0, x1, y1, ... */
static void loop(double* points, int count, double height) {
    int i;
    for (i = 0; i < count; ++i) {
        const double t = 4.0 * i / (count - 1);
        const double u = t < 2.0 ? t - 1.0 : 3.0 - t;
        const double bow = height * (1.0 - u * u);
        points[2 * i] = u;
        points[2 * i + 1] = t < 2.0 ? u + bow : u - bow;
    }
}

static int show(const char* name, int status, double value, const curvewise_error* error) {
    if (status == CURVEWISE_OK) return printf("%s %.17g\n", name, value);
    return printf("%s: %s\n", name, error->message);
}

int main(void) {
    double p[2 * n], q[2 * m], value = 0.0;
    curvewise_curve P, Q, curves[3];
    double pairs[3], stress[3], slopes[3 * 8];
    /* E, yield, Q, b, C1, gamma1, C2, gamma2 */
    const double steel[8] = {200e3, 300.0, -50.0, 8.0, 80e3, 400.0, 5e3, 20.0};
    const double strain[3] = {0.001, 0.02, -0.02};
    curvewise_dtw_options options = CURVEWISE_DTW_DEFAULTS;
    curvewise_curve_length_options length = CURVEWISE_CURVE_LENGTH_DEFAULTS;
    curvewise_error error;
    int status;
    loop(p, n, 0.5);
    loop(q, m, 0.375);
    P = curvewise_rows(p, n, 2);
    Q = curvewise_rows(q, m, 2);

    status = curvewise_area(&P, &Q, NULL, &value, &error); /* NULL: the defaults */
    show("area", status, value, &error);
    status = curvewise_pcm(&P, &Q, NULL, &value, &error);
    show("pcm", status, value, &error);
    status = curvewise_frechet(&P, &Q, NULL, &value, &error);
    show("frechet", status, value, &error);
    options.step_pattern = CURVEWISE_SYMMETRIC2;
    options.window = 80;
    status = curvewise_dtw(&P, &Q, &options, &value, &error);
    show("dtw", status, value, &error);
    length.scale = CURVEWISE_RANGE;
    status = curvewise_curve_length(&P, &Q, &length, &value, &error);
    show("curve_length", status, value, &error);

    curves[0] = P;
    curves[1] = Q;
    curves[2] = curvewise_rows(p, 60, 2); /* the beginning of P */
    status = curvewise_pdist(curves, 3, CURVEWISE_DTW, &options, NULL, pairs, &error);
    show("P_and_Q", status, pairs[0], &error);
    show("P_and_beginning", status, pairs[1], &error);
    show("Q_and_beginning", status, pairs[2], &error);

    status =
        curvewise_material_stress("chaboche-voce", steel, 8, strain, 3, stress, slopes, &error);
    show("driven", status, stress[2], &error);
    show("driven_by_yield", status, slopes[2 * 8 + 1], &error);

    Q.n = 1; /* too short for an area */
    status = curvewise_area(&P, &Q, NULL, &value, &error);
    show("refused", status, value, &error);
    return status == CURVEWISE_INVALID_ARGUMENT ? 0 : 1;
}
