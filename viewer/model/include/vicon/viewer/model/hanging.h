#pragma once

#include <array>
#include <string>

#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/model/thick_slice.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {

/// Where the views lie: the view from inside large; a slice large; supine and prone, each from inside and in a slice;
/// the three planes and the view from inside, all alike.
enum class ViewLayout { three_d_first, two_d_first, both_scans, planes };

/// How slices show densities.
struct SliceLook {
    WindowLevel window;
    ThickSlice thick;
    bool tracks = false;  ///< the wheel follows the lumen, whose rim is drawn
};

/// How a reader hangs a case: what is where, and how it looks.
struct Hanging {
    ViewLayout layout = ViewLayout::three_d_first;
    SlicePlane plane = SlicePlane::axial;  ///< of the large slice
    SliceLook slices;
};

inline constexpr std::size_t kHangings = 4;
/// One a layout, in its order, in the organ's default window.
std::array<Hanging, kHangings> usualHangings();
/// For menus: "3D first".
std::string nameOf(ViewLayout layout);

/// For the reader's settings.
std::string toText(const Hanging& hanging);
/// `otherwise` where the text is none that toText() gave.
Hanging hangingFrom(const std::string& text, const Hanging& otherwise);

}  // namespace vicon::viewer
