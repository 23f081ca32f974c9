#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "flight/steering_keys.h"
#include "reading/reading_tool.h"

class QAction;
class QKeyEvent;

namespace vicon::viewer {

class NavigationPanel;
class ReadingLayout;

/// The flight: planned, guided or free, its controls, keys and the mouse; where the eye is when a scan is opened.
class FlightTool : public ReadingTool {
    Q_OBJECT
public:
    explicit FlightTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void useWords(const OrganWords& words) override;
    void scanLeft() override;
    void scanStays() override { left_.reset(); }
    void scanOpened(const Arrival& arrival) override;
    void placeShown() override;
    void escape() override;
    void style(EndoscopicRequest& request) const override;
    void stop() override { timer_.stop(); }

private:
    // flight_controls.cpp
    void addActions(ReadingLayout& layout);
    void connectPanel();
    void connectViews();
    void clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers);
    void clickedCavity(Pixel at, Qt::KeyboardModifiers modifiers);

    void takePlace(const Arrival& arrival, const OpenScan& left);
    void takeKeptPlace();
    /// To the place of a scan that is opened; in planned flight where it is too narrow for the guided one.
    void comeTo(double station_mm);
    void tick();
    bool waitsForPicture() const;
    bool isHeld() const;
    /// What the reader should know of the eye's place; empty: nothing.
    QString noticeHere() const;
    /// Where there is none says so.
    bool hasPath();
    void setMode(NavigationMode mode);
    void fly(int direction);
    void turnAbout();
    /// Looking into the colon: the way back is what is flown next.
    void goToEnd(Heading end);
    void jumpTo(double station_mm);
    void lookBack(bool on);
    void step(double mm);
    void setSpeed(double mm_s);
    void setAngle(double angle_deg);
    void steer();
    Navigator* navigator() const;

    ReadingLayout* layout_ = nullptr;
    NavigationPanel* panel_;
    QAction *to_first_end_ = nullptr, *to_last_end_ = nullptr;
    QTimer timer_;
    QElapsedTimer clock_;
    SteeringKeys keys_;
    double view_angle_deg_ = 90;
    std::shared_ptr<OpenScan> left_;  // the scan that was read when another was asked for
};

}  // namespace vicon::viewer
