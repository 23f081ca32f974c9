#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

class FilmMaker;

/// Films the way from the eye to its end, while the reader reads on.
class FilmTool : public ReadingTool {
    Q_OBJECT
public:
    explicit FilmTool(Reading& reading);
    void addTo(ReadingLayout& layout) override;

private:
    void startOrCancel();
    void start(const QString& file);

    FilmMaker* maker_;
};

}  // namespace vicon::viewer
