#pragma once

#include <optional>

#include "reading.h"
#include "vicon/core/options.h"

namespace vicon::viewer::test {

/// A study that went through the pipeline, read with what the program itself gives the reading room.
class StudyReader : public Reader {
protected:
    /// Opens the worklist on `store`.
    /// @param name before the names of the screenshots
    /// @param config more of a configuration; empty: whoever runs this may sign, and nothing is sent
    void openStore(const std::filesystem::path& store, const std::string& name,
                   const std::filesystem::path& config = {});
    void screenshot(const std::string& step) const { Reader::screenshot((name_ + "-" + step).c_str()); }
    void screenshotNow(const std::string& step) const { Reader::screenshotNow((name_ + "-" + step).c_str()); }
    void fastest() const;
    void jumpTo(double station_mm) const;
    /// From the rectum to the caecum and back, along the path, at the greatest speed.
    void flyThereAndBack() const;
    /// A marker on the wall ahead.
    /// @param by from the middle of the picture
    void place(int color_key, QPoint by) const;
    void writeNote(int row, const QString& note) const;
    static std::vector<std::string> filesIn(const std::filesystem::path& folder);

    std::string case_id_, patient_id_, name_;
    std::filesystem::path case_folder_;
    std::optional<Config> config_;
};

/// The steps of a reading that need one scan, in their order; each leaves its picture.
class StudyWalk : public StudyReader {
protected:
    void markAndEdit();
    void measure();
    void lookBelowTheWall();
    void circleAndTakeDensity();
    void keepPictureAndMarkers();
    void writeReport();
    /// Findings of the markers, categories as proposed, the pages looked at, signed.
    /// @param findings that are made of the markers
    void signReport(int findings);
    /// The form says that the archive keeps `objects` of the report, or more.
    void awaitArchive(int objects) const;
    /// A finding's size, by the reader.
    void sayRead(int finding, const QString& size_mm) const;
    void signIt() const;
    /// The signed report is opened again, the first finding's size said anew, and signed.
    void amendReport();
    void closeAndReopen();
};

/// A prepared store that tests may change: a copy of what the build folder keeps, made by the built command on first
/// use and brought up to date by `vicon work` later, once a process.
/// @param source what is imported
std::filesystem::path preparedStore(const std::string& name, const std::filesystem::path& source,
                                    const std::filesystem::path& copy);
/// The phantom's study, supine and prone, made on first use.
std::filesystem::path phantomStudy();

}  // namespace vicon::viewer::test
