#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

// What a marker may carry. Each has one JSON form, described in docs/dev/schemas/markers.schema.json; the readers throw
// nlohmann::json::exception for anything else.

/// A finding's size in a plane through the two points that a reader clicked on its edges; of an outlined polyp in the
/// axial, coronal or sagittal plane that shows it largest.
struct PlaneSize {
    double diameter_mm = 0;  ///< the largest of its cross-section
    Point3 from_mm, to_mm;   ///< the ends of that diameter
    double area_mm2 = 0;     ///< of the cross-section above the line between the clicked points, or the rim's
    Point3 middle_mm;        ///< of that line
    Vector3 along, up;       ///< unit vectors in the plane: along the line; into the lumen
};
nlohmann::json toJson(const PlaneSize& size);
PlaneSize planeSizeFromJson(const nlohmann::json& json);

/// A polyp's size, found from one point on it, corrected for the scan's blur.
struct PolypSize {
    double diameter_mm = 0;                                 ///< of the head, the largest in space
    double least_mm = 0, most_mm = 0;                       ///< eight in ten true diameters lie between them
    Point3 from_mm, to_mm;                                  ///< the ends of the diameter
    double height_mm = 0;                                   ///< over the middle of its rim
    double volume_ml = 0;                                   ///< of the head over its rim
    std::optional<double> volume_least_ml, volume_most_ml;  ///< eight in ten true volumes lie between them
    std::vector<Point3> rim_mm;                             ///< around it, where it ends on the wall or at its stalk
};
/// Decimals that a polyp's volume and its bounds are told with: one of 6 mm has 0.057 ml.
inline int volumeDecimals(double volume_ml)
{
    return volume_ml < 1 ? 3 : 2;
}
nlohmann::json toJson(const PolypSize& size);
PolypSize polypSizeFromJson(const nlohmann::json& json);

/// A finding's size as a reader measured it between two points of the wall or of a slice, or as it was outlined.
struct MarkerSize {
    double straight_mm = 0;          ///< between the two points
    bool in_slice = false;           ///< the two points were clicked in a slice, and need not lie on the wall
    std::optional<double> along_mm;  ///< over the wall; absent where no way over it joins them
    Point3 from_mm, to_mm;
    std::optional<PlaneSize> plane;  ///< in the plane where the finding is largest
    std::optional<PolypSize> polyp;  ///< where the finding was outlined: then the two points are its diameter's ends
};
/// How far a place lies outside of what was measured, taken as the ball over the line between the two points: 0
/// anywhere in a mass, which reaches as far above its base as that is wide.
double outsideOf_mm(const MarkerSize& size, Point3 place);
/// A density or a size belongs to a marker this near to where it was taken.
inline constexpr double kMeasureNear_mm = 10;
nlohmann::json toJson(const MarkerSize& size);
MarkerSize markerSizeFromJson(const nlohmann::json& json);

/// Densities of the tissue within a ball: the virtual biopsy of a finding. sampleDensity() takes it.
struct DensitySample {
    static constexpr int kBin_hu = 25;
    static constexpr std::size_t kLeastVoxels = 20;  ///< of fewer, noise of 25 HU leaves the mean out by 6 HU and more

    Point3 centre_mm;
    double radius_mm = 0;
    double margin_mm = 0;     ///< nothing nearer than this to gas or fluid was taken
    std::size_t voxels = 0;   ///< 0, or kLeastVoxels and more
    double mean_hu = 0;       ///< 0 where there are no voxels, as are the next two
    double sd_hu = 0;         ///< standard deviation
    double fat_fraction = 0;  ///< of the voxels, those of fat's density, -200 to -30 HU
    int from_hu = 0;          ///< lower bound of the histogram's first bin, a multiple of kBin_hu
    std::vector<std::size_t> counts;
};
nlohmann::json toJson(const DensitySample& sample);
DensitySample densitySampleFromJson(const nlohmann::json& json);

/// The view from which a marker was placed.
struct MarkerView {
    Point3 eye_mm;
    Vector3 forward, up;    ///< of the view; need not be unit vectors where another program wrote them
    double station_mm = 0;  ///< of the eye, which is not the marker's
};
nlohmann::json toJson(const MarkerView& view);
MarkerView markerViewFromJson(const nlohmann::json& json);

}  // namespace vicon
