#pragma once

#include "reading/reading_tool.h"

class QAction;
class QDockWidget;

namespace vicon::viewer {

class BandView;
class PictureView;

/// All of the wall at once: the unfolded cube around the eye, and the colon cut open as a band, each in a view of its
/// own beside the others.
class PanoramaTool : public ReadingTool {
    Q_OBJECT
public:
    explicit PanoramaTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void scanLeft() override;
    void scanOpened(const Arrival&) override;
    void scanStays() override { drawBand(true); }
    void draw(bool still) override;
    void stop() override;

private:
    void addCube(ReadingLayout& layout);
    void addBand(ReadingLayout& layout);
    void showDock(QDockWidget* dock, bool on, Qt::Orientation along, double share) const;
    void drawCube(bool still);
    void drawBand(bool still);
    /// What is measured, over the cube.
    void drawLine();
    /// The point of the wall that the cube shows there.
    std::optional<ClickedPoint> cubePointAt(Pixel at, Qt::KeyboardModifiers modifiers = {}) const;
    void clickedCube(Pixel at, Qt::KeyboardModifiers modifiers);
    void clickedBand(Point3 point, Qt::KeyboardModifiers modifiers);
    /// What a click on the wall does, in either view.
    void clickedWall(const ClickedPoint& point);

    PictureView* cube_;
    BandView* band_;
    QDockWidget *cube_dock_ = nullptr, *band_dock_ = nullptr;
    QAction *cube_on_ = nullptr, *band_on_ = nullptr;
    ShownPicture shown_cube_;
    Point3 cube_eye_mm_;  ///< of the cube that is looked at by now
    bool cube_under_way_ = false, cube_is_old_ = false;
};

}  // namespace vicon::viewer
