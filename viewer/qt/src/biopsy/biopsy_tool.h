#pragma once

#include "reading/reading_tool.h"
#include "vicon/cases/density_sample.h"

namespace vicon::viewer {

class PeelingPanel;

/// The virtual biopsy: a circle around a finding is peeled alone, and the density below it is kept with its marker.
class BiopsyTool : public ReadingTool {
    Q_OBJECT
public:
    /// @param panel shows the densities
    BiopsyTool(Reading& reading, PeelingPanel& panel) : ReadingTool(reading), panel_(panel) {}

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival&) override { circle_.reset(); }
    void nextClickChanged() override;
    void complete(EndoscopicRequest& request) const override;

private:
    /// Stays on the wall while the eye moves.
    struct Circle {
        Point3 centre_mm;
        double radius_mm = 0;
    };
    void start();
    void circled(Pixel centre, double radius_px);
    double raisedOver(Point3 middle, Vector3 inwards, Pixel centre, double radius_px) const;
    void show(const DensitySample& biopsy);

    PeelingPanel& panel_;
    std::optional<Circle> circle_;
};

}  // namespace vicon::viewer
