#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vicon/cases/marker.h"
#include "vicon/core/corrections.h"

namespace vicon::viewer {

// What the reader's next click is for. One of these is in use at a time.

/// A click shows what is there.
struct Idle {};
struct PlaceMarker {
    MarkerColor color = MarkerColor::red;
};
struct MoveMarker {
    std::string id, scan_id;
};
/// The same finding is chosen in the list of markers; clicks in pictures show what is there.
struct PairMarker {
    std::string id, scan_id;
};
struct Correct {
    Correction kind = Correction::add;
};
struct Measure {
    std::vector<Point3> ends_mm;  ///< clicked so far, one at most
    bool on_wall = true;          ///< all of them; else the size is straight, as in a slice
    std::string scan_id = {};     ///< in which the first end was clicked; the other one belongs there, too
};
/// The polyp that is clicked on is outlined, in whichever scan.
struct OutlinePolyp {};
/// A circle is drawn around a finding; clicks show what is there.
struct CircleFinding {};

using ToolInUse =
    std::variant<Idle, PlaceMarker, MoveMarker, PairMarker, Correct, Measure, OutlinePolyp, CircleFinding>;

/// A point that was clicked in a view.
struct PickedPoint {
    Point3 at_mm;
    std::string scan_id;
    bool on_wall = false;  ///< chosen on the surface of the cells, in an endoscopic picture
    bool wants_marker = false;
    double voxel_mm = 0;  ///< of the scan, along its shortest side: a shorter line is no size
};

// What a click means.
struct ShowPoint {};
struct AddMarker {
    MarkerColor color = MarkerColor::red;
};
struct MoveMarkerHere {
    std::string id;
};
/// Still to be checked; Interaction::finish() when it was accepted.
struct CorrectHere {
    Correction kind = Correction::add;
};
struct AwaitOtherEnd {};
struct MeasureBetween {
    Point3 from_mm, to_mm;
    bool on_wall = true;
};
struct OutlineHere {};
/// Nothing is done.
struct Refuse {
    enum class Why { end_in_other_scan, end_in_same_place, marker_of_other_scan } why = Why::end_in_other_scan;
    std::string marker_id;  ///< of marker_of_other_scan
};

using ClickMeaning =
    std::variant<ShowPoint, AddMarker, MoveMarkerHere, CorrectHere, AwaitOtherEnd, MeasureBetween, OutlineHere, Refuse>;

// What choosing a marker in the list means.
struct ShowMarker {};
struct PairWith {
    std::string id;  ///< the marker whose partner was looked for
};
struct RefusePair {};

using ChoiceMeaning = std::variant<ShowMarker, PairWith, RefusePair>;

/// What the reader is about to do with the next click: the tool that was chosen last, until it is used, given up, or
/// what it is for is gone.
///
///     event                         tool in use afterwards
///     begin(tool)                   that tool
///     click adds, moves a marker    Idle
///     click on a size's first end   Measure with this end; on the other end: Idle
///     click outlines a polyp        Idle
///     click refused                 as before; Idle where a marker of the other scan was to be moved
///     finish(), escape()            Idle
///     choose(marker) of a pair      Idle
///     another scan is opened,       as before, Measure without an end
///     or that of its end is closed
///     the marker is gone            Idle, of MoveMarker and PairMarker
class Interaction {
public:
    const ToolInUse& tool() const { return tool_; }
    template <class Tool>
    const Tool* inUse() const
    {
        return std::get_if<Tool>(&tool_);
    }
    /// Whether a finding is measured, outlined or circled.
    bool measures() const { return inUse<Measure>() || inUse<OutlinePolyp>() || inUse<CircleFinding>(); }
    /// In a picture; a drawn circle begins with one, too.
    bool awaitsClick() const;

    void begin(ToolInUse tool) { tool_ = std::move(tool); }
    void escape() { tool_ = Idle{}; }
    /// What the tool is for is done.
    void finish() { tool_ = Idle{}; }
    ClickMeaning click(const PickedPoint& point);
    ChoiceMeaning choose(const Marker& marker);
    void scanChanged();
    /// @param markers all of the case, as they are now
    void markersChanged(const std::vector<Marker>& markers);

private:
    ClickMeaning measureAt(const PickedPoint& point);

    ToolInUse tool_;
};

}  // namespace vicon::viewer
