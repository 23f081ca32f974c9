#pragma once

#include "reading/reading_tool.h"
#include "slices/measured_line.h"
#include "vicon/cases/density_sample.h"

namespace vicon::viewer {

class PeelingPanel;

/// The virtual biopsy: a finding is circled, from inside or in a slice. From inside it is peeled alone; the density
/// below it is kept with its marker, and slices show where it was taken.
class BiopsyTool : public ReadingTool {
    Q_OBJECT
public:
    /// @param panel shows the densities
    BiopsyTool(Reading& reading, PeelingPanel& panel) : ReadingTool(reading), panel_(panel) {}

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override;
    void markersChanged() override;
    void nextClickChanged() override;
    void complete(EndoscopicRequest& request) const override;

private:
    /// Stays where it is while the eye moves.
    struct Circle {
        Point3 centre_mm;
        double radius_mm = 0;
        bool on_wall = true;  ///< it is seen from inside
    };
    /// Measured, with no marker beside it yet.
    struct Unkept {
        DensitySample sample;
        QString text;
    };
    void start();
    void giveUp();
    void circled(Pixel centre, double radius_px);
    void circledSlice(const PlaneView& view, Pixel centre, double radius_px);
    void drawSampled(const std::optional<SampledBall>& ball);
    double raisedOver(Point3 middle, Vector3 inwards, Pixel centre, double radius_px) const;
    void show(const DensitySample& biopsy);
    bool keep();

    PeelingPanel& panel_;
    std::optional<Circle> circle_;
    std::optional<Unkept> unkept_;
};

}  // namespace vicon::viewer
