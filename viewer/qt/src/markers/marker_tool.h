#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

class MarkerTable;
class ReadingLayout;

/// Markers: placed, moved, paired, changed and removed; their list, their files, and what is known of one.
class MarkerTool : public ReadingTool {
    Q_OBJECT
public:
    explicit MarkerTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void useWords(const OrganWords& words) override;
    void markersChanged() override;
    bool act(const ClickMeaning& meaning, const ClickedPoint& point) override;
    void escape() override;

    std::optional<StepNumber> toUndo() const override;
    std::optional<StepNumber> toRedo() const override;
    void undo() override;
    void redo() override;
    bool stepUnderWay() const override;

private:
    void addActions(ReadingLayout& layout);
    void connectTable();
    void startPlacing(MarkerColor color);
    void startMoving(const Marker& marker);
    void pair(const Marker& marker);
    void choose(const Marker& marker);
    void add(MarkerColor color, const ClickedPoint& point);
    void warnOffWall(const Marker& marker, const Lumen& lumen);
    void move(const std::string& id, const ClickedPoint& to);
    void removeChosen();
    void refuseMove(const std::string& id);
    void chooseFile(bool to_save);
    void load(const QString& file);
    // marker_information.cpp
    void showInformation();

    MarkerTable* table_;
    bool warned_off_wall_ = false;
};

}  // namespace vicon::viewer
