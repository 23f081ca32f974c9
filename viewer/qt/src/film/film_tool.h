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
    /// A film that waits for its name: of what the reader saw when it was asked for.
    struct Asked {
        std::shared_ptr<OpenScan> scan;
        EndoscopicRequest request;
        double from_mm = 0;
        Heading heading = Heading::caecum;
        double step_mm = 0;
    };
    void startOrCancel();
    Asked asFrom(const NavigationState& from) const;
    /// @param file empty: there is no name for it
    void start(const QString& file);

    FilmMaker* maker_;
    std::optional<Asked> asked_;
};

}  // namespace vicon::viewer
