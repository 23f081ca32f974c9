#pragma once

#include <array>
#include <string>
#include <vector>

#include "vicon/cases/marker.h"
#include "vicon/core/skeleton.h"
#include "vicon/viewer/model/organ_words.h"
#include "vicon/viewer/model/overlay.h"

namespace vicon::viewer {

inline constexpr Rgb kLetterColor{255, 214, 102};
inline constexpr Rgb kTextColor{235, 235, 235};
inline constexpr Rgb kWarningColor{255, 120, 40};
inline constexpr Rgb kCrosshairColor{90, 200, 250};
inline constexpr Rgb kPathColor{120, 235, 255};
inline constexpr Rgb kBridgeColor{255, 90, 220};
inline constexpr Rgb kHereColor{255, 255, 255};
Rgb colorOf(MarkerColor color);
/// Lighter: thin letters of a full red are not read on tissue.
Rgb labelColorOf(MarkerColor color);

/// Height of text that reads well in a picture of this size, in pixels.
/// @param pixel_ratio of the screen: how many of its pixels are one of 96 to the inch
double textHeightFor(int width, int height, double pixel_ratio = 1);

/// The letters of the four sides of a picture whose axes are these, in the middle of each edge of `area`.
void addLetters(Overlay& overlay, const Area& area, Vector3 right, Vector3 down, double text_px);

/// A bar of a round number of centimetres or millimetres, with its length, ending at the lower right corner of `area`.
void addScaleBar(Overlay& overlay, const Area& area, double mm_per_pixel, double text_px);

/// Six letters around a point, as they lie seen from the eye; those that point away from it are dim.
void addTriad(Overlay& overlay, Pixel centre, double radius_px, const Pose& pose, double text_px);

/// Lines of text from the upper left corner of `area`, none wider than it.
void addLines(Overlay& overlay, const Area& area, const std::vector<OverlayText>& lines, double text_px);
/// The same lines at that height, those that are too long going on in the next, to `most` of each; then "…".
std::vector<OverlayText> broken(const std::vector<OverlayText>& lines, double width_px, double text_px,
                                std::size_t most = 3);
/// Where a caption lies: beside the letter in the middle of the upper edge; below it in a picture too narrow for that.
/// @param longest_line in heights of the text
Area captionArea(double width_px, double height_px, double text_px, double longest_line);
/// How many lines addLines() has room for in an area of this height; at least one.
int linesIn(double height_px, double text_px);
/// Leaves so many lines, at least one, where there are more: the last ones go, but no warning.
void leaveOut(std::vector<OverlayText>& lines, int most);
/// How high the text may be for that many lines to fit into an area of this height.
double heightOfText(std::size_t lines, double height_px);

/// A ring around a marker with its id beside it; the middle stays free.
void addMarkerRing(Overlay& overlay, Pixel at, double radius_px, const Marker& marker, double text_px);

/// Cross lines through a point over `area`, with a gap that leaves the point free.
void addCrosshair(Overlay& overlay, const Area& area, Pixel at, double gap_px);

/// The skeleton's pieces solid, its bridges dashed in another colour.
void addSkeleton(Overlay& overlay, const Skeleton& skeleton, const PlaneView& view, double width_px);

/// An arrow head at a place, pointing where the eye looks; a ring where it looks along the direction of view.
void addHere(Overlay& overlay, const PlaneView& view, const Pose& pose, double size_px);

/// "412 mm from the rectum (26 %)" and "1180 mm from the caecum".
std::array<std::string, 2> stationTexts(double station_mm, double length_mm, const OrganWords& words);

/// Cuts UTF-8 text between words into lines of at most `most` characters; what does not fit into `lines` ends in "…".
std::vector<std::string> wrapped(const std::string& text, std::size_t most, std::size_t lines);

}  // namespace vicon::viewer
