// Curves in doubles that do not belong to the caller: copies, row by row. They are made if they
// must outlive the caller's curves, and for curves of floats for the time of a computation. O(n)
// time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "curves/checks.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::curves {

// A curve with a copy of its points. Flat if the caller's curve is, for messages.
class OwnedCurve {
   public:
    // Throws Stopped where the poller says so.
    OwnedCurve(const CurveView& curve, runtime::Poller& poller);
    // Valid where this is moved to, too.
    CurveView view() const noexcept;

   private:
    bool is_flat_;
    std::ptrdiff_t dim_;
    runtime::ScratchVector<double> points_;
};

// The caller's curve where that is of doubles, or a copy of one of floats.
class CurveInDoubles {
   public:
    CurveInDoubles(const CurveView& curve, runtime::Poller& poller) : given_(curve) {
        if (curve.has_floats()) copy_.emplace(curve, poller);
    }
    CurveView view() const noexcept { return copy_ ? copy_->view() : given_; }

   private:
    CurveView given_;
    std::optional<OwnedCurve> copy_;
};

// Checks a curve of a list, which may have floats. The result then refers to the floats, and
// LoadedCurve converts it for computations.
CheckedCurve checked_listed(const CurveView& curve, std::string name, runtime::Poller& poller,
                            bool on_sphere);

class LoadedCurve {
   public:
    // `listed` must outlive this.
    LoadedCurve(const CheckedCurve& listed, runtime::Poller& poller) : listed_(listed) {
        if (!listed.curve.has_floats()) return;
        points_.emplace(listed.curve, poller);
        copy_ = listed;
        copy_->curve = points_->view();
    }
    const CheckedCurve& checked() const noexcept { return copy_ ? *copy_ : listed_; }

   private:
    const CheckedCurve& listed_;
    std::optional<OwnedCurve> points_;
    std::optional<CheckedCurve> copy_;
};

}  // namespace curvewise::curves
