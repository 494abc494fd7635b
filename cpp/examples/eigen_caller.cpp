// Passes Eigen matrices of every layout as curves, without a copy. CMakeLists.txt compiles this
// file with -march=native, though the library is not. Eigen's packets and alignment here differ
// from those inside the library, and the two never meet.
#include <Eigen/Core>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <curvewise/eigen.hpp>

namespace {

using curvewise::curve_view;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

// A closed loop: x a triangle wave, y a parabola on each branch.
Eigen::MatrixX2d loop(Eigen::Index n, double height) {
    Eigen::MatrixX2d points(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double t = 4.0 * static_cast<double>(i) / static_cast<double>(n - 1);
        const double u = t < 2.0 ? t - 1.0 : 3.0 - t;
        const double bow = height * (1.0 - u * u);
        points.row(i) << u, t < 2.0 ? u + bow : u - bow;
    }
    return points;
}

// Your own functions take Eigen::Ref as usual.
double distance(const Eigen::Ref<const Eigen::MatrixX2d>& P, const RowMajor& Q) {
    return curvewise::dtw(curve_view(P), curve_view(Q));
}

}  // namespace

int main() {
    const Eigen::MatrixX2d P = loop(129, 0.5);  // column-major, Eigen's default
    const RowMajor Q = loop(65, 0.375);
    std::printf("column_and_row_major %.17g\n", distance(P, Q));

    // Strain, temperature and stress of each increment are side by side; the curve uses two of
    // them.
    Eigen::Matrix<double, 129, 3, Eigen::RowMajor> history;
    history << P.col(0), Eigen::VectorXd::Constant(129, 293.15), P.col(1);
    using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;  // of columns, of rows
    const Eigen::Map<const Eigen::MatrixX2d, 0, Strides> states(history.data(), 129, 2, {2, 3});
    std::printf("strided_map %.17g\n", curvewise::dtw(curve_view(states), curve_view(Q)));

    const Eigen::Matrix2Xd across = P.transpose();  // points are its columns
    std::printf("transposed %.17g\n",
                curvewise::dtw(curve_view(across.transpose()), curve_view(Q)));
    std::printf("block %.17g\n",
                curvewise::dtw(curve_view(P.topRows(40)), curve_view(Q.bottomRows(50))));
    std::printf("reversed %.17g\n",
                curvewise::area(curve_view(P), curve_view(RowMajor(Q.colwise().reverse()))));

    // An expression without its own memory is evaluated first: here with this file's own packets.
    const RowMajor scaled = 0.5 * P;
    std::printf("scaled %.17g\n", curvewise::dtw(curve_view(scaled), curve_view(Q)));
    const Eigen::VectorXd stress = P.col(1);
    std::printf("flat %.17g\n", curvewise::dtw(curve_view(stress), curve_view(Q.col(1))));
}
