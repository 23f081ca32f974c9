#pragma once

#include <map>
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
    void drawImpression();
    /// Map and study beside each other, where nothing was found; false, and nothing drawn, where something was or they
    /// do not fit.
    bool drawQuietStudy();
    void drawMap();
    void drawFindingTable();
    void drawFinding(const FindingWithFacts& finding);
    void drawFindingHead(const FindingWithFacts& finding);
    void drawSights(const FindingWithFacts& finding);
    void drawStudy();
    void drawScans();
    void drawSignature();
    /// The markers of no finding.
    std::vector<const MarkerEntry*> looseMarkers() const;
    void drawQuality();
    void drawQualityOf(const std::vector<const ScanEntry*>& scans);
    void drawQualityHead(const std::vector<const ScanEntry*>& scans);
    FramedPicture overviewOf(const ScanEntry& entry);
    void drawMarkers();
    void drawMarkerTable(const std::vector<const MarkerEntry*>& markers);
    void drawMarker(const MarkerEntry& entry);
    /// The page into the row of the table of markers, or of findings, that is about this one.
    void fillPageOf(const std::string& id);
    void drawNote(const Marker& marker, const std::vector<TextLine>& note);
    void drawMarkerHead(const MarkerEntry& entry);
    /// Side by side over the page's width, all as high as that allows, at most `tallest`.
    void drawStrip(const std::vector<FramedPicture>& pictures, double tallest);
    double stripHeight(const std::vector<FramedPicture>& pictures, double tallest) const;
    /// @param of what captions name; @param measures with what was measured there, too
    void drawMarkerPictures(const MarkerEntry& entry, const std::string& of, bool measures, double tallest);
    FramedPicture framed(const std::filesystem::path& file, double print_width, const std::string& caption,
                         const std::string& kind, const std::string& of);

    /// A row of a table, whose last column, the page, is filled in once its entry is drawn.
    struct TableRow {
        int page = 0;
        double x = 0, y = 0;
    };

    const ReportContent& content_;
    PageFlow& flow_;
    PictureShelf shelf_;
    std::map<std::string, TableRow> rows_;  ///< by the id of marker or finding
    std::vector<std::string> warnings_;
};

}  // namespace vicon::report
