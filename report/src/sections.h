#pragma once

#include <map>
#include <string>
#include <vector>

#include "blocks.h"
#include "strip_chart.h"
#include "vicon/report/content.h"

namespace vicon::report {

/// Whose reports they are.
struct Site {
    std::vector<std::string> name_lines;  ///< name and address
    std::filesystem::path logo;           ///< PNG; empty: none
};

/// A marker whose pictures are shown.
struct ShownMarker {
    const MarkerEntry* entry = nullptr;
    std::string head;  ///< which scan, which marker
};

/// Pictures side by side.
struct PictureStrip {
    std::vector<FramedPicture> pictures;
    double tallest = 0;  ///< points
};

/// Pictures of a place, strip below strip; of two places, each its half of the width.
struct PictureBlock {
    std::vector<std::string> heads;
    std::vector<PictureStrip> strips;
};

/// The parts of a report, drawn one after the other.
class Sections {
public:
    Sections(const ReportContent& content, Site site, PageFlow& flow, const PrintPictures* begun)
        : content_(content), site_(std::move(site)), flow_(flow), shelf_(flow.pdf, begun)
    {
    }

    void draw();
    /// What could not be printed as it is.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    static constexpr double kColumnGap = 18;  ///< points

    /// With the site's name and logo, where the configuration has them.
    void drawTitle();
    double drawSite(double width);
    void drawCase();
    void drawImpression();
    /// Whether there is nothing in the colon to be told.
    bool isQuiet() const;
    /// What is said of the study beside the map, where that leaves the room; false, and nothing drawn, where it does
    /// not.
    bool drawMapBesideFacts();
    /// The map of one scan leaves the room for what was measured of the colon's parts as well.
    bool drawOneMapBesideParts();
    /// The same where it leaves less: map, facts and parts side by side.
    bool drawOneMapInThreeColumns(double room);
    /// What the page has for the map, when all that follows has its place.
    double roomForMap() const;
    /// @param of_colon with what is said of the colon
    std::vector<Statement> studyFacts(bool of_colon) const;
    std::vector<Statement> examinationStatements() const;
    void drawMap();
    double findingTableHeight() const;
    void drawFindingTable();
    /// With earlier reports, where the reader confirmed any.
    void drawComparison();
    void drawFinding(const FindingWithFacts& finding);
    void drawFindingHead(const FindingWithFacts& finding);
    /// The pictures of its sights that the reader chose, two scans side by side.
    std::vector<PictureBlock> sightsOf(const FindingWithFacts& finding);
    void drawStudy();
    double studyHeight() const;
    void drawScans();
    void drawSignature();
    std::vector<TextLine> signatureLines() const;
    double signatureHeight() const;
    /// The markers of no finding.
    std::vector<const MarkerEntry*> looseMarkers() const;
    /// What was not told of it yet: strips and parts.
    void drawQuality();
    double qualityHeight() const;
    /// As much of it as page one has the room for.
    void drawQualityOnPageOne();
    /// The colons laid straight; false where no scan has one, or they are drawn already.
    /// @param below of what follows on the same page: points
    bool drawStrips(double below);
    double stripsHeight() const;
    /// @param headed whether it needs a heading of its own
    void drawParts(bool headed);
    /// Whether what is to be said of the scans stands with their strips: that is little, and nothing was found.
    bool scansToldInStrips() const;
    std::vector<const ScanEntry*> stripScans() const;
    std::vector<StripColon> strips() const;
    StripColon stripOf(const ScanEntry& entry) const;
    /// Whose parts are to be told below each other in a table; none where they were told already.
    std::vector<const ScanEntry*> measuredScans() const;
    double partRowsHeight() const;
    double tailHeight() const;
    /// Of what stands last.
    double endHeight() const;
    double partColumn(std::size_t n) const;
    static double partHeadHeight();
    void drawPartHead();
    double scanRowsHeight(const ScanEntry& entry) const;
    void drawScanRows(const ScanEntry& entry);
    /// Of the scans in a line each; 0 where there is more to be said of one.
    double briefScansHeight() const;
    std::vector<Statement> briefScans() const;
    FramedPicture overviewOf(const ScanEntry& entry);
    void drawMarkers();
    void drawMarkerTable(const std::vector<const MarkerEntry*>& markers);
    void drawMarker(const MarkerEntry& entry);
    /// The page into the row of the table of markers, or of findings, that is about this one.
    void fillPageOf(const std::string& id);
    void drawNote(const Marker& marker, const std::vector<TextLine>& note);
    void drawMarkerHead(const MarkerEntry& entry);
    /// @param shown one or two markers
    /// @param measured the one with what was measured there; may be none
    PictureBlock blockOf(const std::vector<ShownMarker>& shown, const MarkerEntry* measured);
    void addMeasures(PictureBlock& block, const MarkerEntry& entry);
    std::vector<FramedPicture> fromInside(const MarkerEntry& entry);
    FramedPicture slicesOf(const MarkerEntry& entry);
    /// As high as they fit side by side over the page's width, and as the strip allows.
    double stripHeight(const PictureStrip& strip) const;
    double captionHeight(const PictureStrip& strip) const;
    double heightOf(const PictureBlock& block) const;
    void drawStrip(const PictureStrip& strip);
    void drawPictures(const PictureBlock& block);
    FramedPicture framed(const std::filesystem::path& file, double print_width, const std::string& caption,
                         const std::string& kind, const std::string& of);

    /// A row of a table, whose last column, the page, is filled in once its entry is drawn.
    struct TableRow {
        int page = 0;
        double x = 0, y = 0;
    };

    const ReportContent& content_;
    const Site site_;
    PageFlow& flow_;
    PictureShelf shelf_;
    std::map<std::string, TableRow> rows_;  ///< by the id of marker or finding
    bool parts_told_ = false;               ///< what was measured of the colon's parts
    bool strips_told_ = false;
    std::vector<std::string> warnings_;
};

}  // namespace vicon::report
