// The requirements of every measure on its curves. They are checked before any work, in one order
// and with one wording, for one pair and for a thousand curves: the coordinates of all curves, then
// their numbers of points, then every number. std::invalid_argument states the error, its place,
// and the valid values. One pass over the points.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/options.hpp"
#include "runtime/poller.hpp"

namespace curvewise::curves {

struct Requirements {
    const char* measure;
    std::ptrdiff_t min_points;
    bool planar;             // exactly two coordinates, x and y
    bool on_sphere = false;  // or longitude and latitude
};

// One curve, "P", or the curves of a list, "XA[0]", "XA[1]", ...: the caller's, with the names
// that messages give them.
class CurveList {
   public:
    CurveList(const CurveView& curve, const char* name) noexcept
        : curves_(&curve), size_(1), name_(name) {}
    CurveList(const std::vector<CurveView>& curves, const char* name) noexcept
        : curves_(curves.data()), size_(curves.size()), name_(name), is_list_(true) {}

    std::size_t size() const noexcept { return size_; }
    const CurveView& operator[](std::size_t i) const noexcept { return curves_[i]; }
    std::string name_of(std::size_t i) const {
        return is_list_ ? std::string(name_) + "[" + std::to_string(i) + "]" : name_;
    }

   private:
    const CurveView* curves_;
    std::size_t size_;
    const char* name_;
    bool is_list_ = false;
};

// A curve of doubles that was checked to be finite, and on the sphere if required, with the largest
// |coordinate|. Refers to the caller's points.
struct CheckedCurve {
    CheckedCurve(const CurveView& view, std::string view_name, runtime::Poller& poller);
    // Asked here, and not in a call: where no measure of a kind is on the sphere, it costs nothing.
    template <class Name>
    CheckedCurve(const CurveView& view, Name&& view_name, runtime::Poller& poller, bool is_geo)
        : CheckedCurve(view, std::string(std::forward<Name>(view_name)), poller) {
        if (is_geo) put_on_sphere();
    }

    // One that was checked before.
    CheckedCurve(const CurveView& view, double its_largest, bool is_on_sphere) noexcept
        : curve(view), largest(its_largest), on_sphere(is_on_sphere) {}

    CurveView curve;
    std::string name;
    double largest;
    bool on_sphere = false;

   private:
    void put_on_sphere();
};

// "(5, 2)", or "(5,)" for a flat list.
std::string shape_of(const CurveView& curve);

// The shapes of the curves of both sides, which must agree in their number of coordinates. A list
// that is compared with itself is given once.
void check_shapes(const Requirements& needs, const CurveList& first, const CurveList& second);
void check_shapes(const Requirements& needs, const CurveList& curves);

void check_equal_shapes(const CurveView& P, const CurveView& Q, const char* measure);

// Throws "window is -1; give ..." for a number below the range's least.
void check_whole_number(const char* option, std::ptrdiff_t value, const WholeNumberRange& range);
// Throws for a largest distance that is nan, or negative where distances are not.
void check_limit(const char* option, double limit, bool may_be_negative);

}  // namespace curvewise::curves
