#pragma once

#include <string>
#include <vector>

#include "blocks.h"
#include "vicon/report/content.h"

namespace vicon::report {

/// The parts of a report, drawn one after the other.
class Sections {
public:
    Sections(const ReportContent& content, PageFlow& flow) : content_(content), flow_(flow), shelf_(flow.pdf) {}

    void draw();
    /// What could not be printed as it is.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    void drawTitle();
    void drawCase();
    void drawScans();
    void drawScan(const ScanEntry& entry);
    /// Two scans side by side; false, and nothing drawn, when what is left of the page does not hold them.
    bool drawScanPair(const ScanEntry& first, const ScanEntry& second);
    void drawQuality();
    void drawQualityOf(const std::vector<const ScanEntry*>& scans);
    void drawQualityHead(const std::vector<const ScanEntry*>& scans);
    FramedPicture overviewOf(const ScanEntry& entry);
    void drawMarkers();
    void drawMarkerTable();
    void drawMarker(const MarkerEntry& entry);
    void fillPageOf(const MarkerEntry& entry);
    void drawNote(const Marker& marker, const std::vector<TextLine>& note);
    void drawMarkerHead(const MarkerEntry& entry);
    void drawMarkerPictures(const FramedPicture& endoscopic, const FramedPicture& slices, double height);
    void drawMeasuresPicture(const MarkerEntry& entry, const std::string& mark);
    FramedPicture framed(const std::filesystem::path& file, double print_width, const std::string& caption,
                         const std::string& kind, const std::string& of);

    /// A row of the table of markers, whose page is filled in once its entry is drawn.
    struct TableRow {
        int page = 0;
        double y = 0;
    };

    const ReportContent& content_;
    PageFlow& flow_;
    PictureShelf shelf_;
    std::vector<TableRow> table_;
    std::vector<std::string> warnings_;
};

}  // namespace vicon::report
