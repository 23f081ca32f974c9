// What is written over pictures of any size: nothing over anything else.
#include <gtest/gtest.h>

#include "caption_panel.h"
#include "pictures.h"
#include "scan_fixture.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/file.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/model/transfer_function.h"

namespace vicon::viewer {
namespace {

constexpr std::array<std::array<int, 2>, 9> kSizes{{{200, 200},
                                                    {300, 250},
                                                    {500, 400},
                                                    {700, 600},
                                                    {1200, 900},
                                                    {2400, 1800},
                                                    {1600, 600},
                                                    {600, 1600},
                                                    {4096, 4096}}};

bool touch(const Area& a, const Area& b)
{
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// Texts that lie over one another, or none.
std::string overlapping(const std::vector<OverlayText>& texts)
{
    for (std::size_t n = 0; n < texts.size(); ++n)
        for (std::size_t other = 0; other < n; ++other)
            if (touch(textArea(texts[n]), textArea(texts[other])))
                return texts[other].text + " | " + texts[n].text;
    return {};
}

Caption longCaption()
{
    return {"Wolfeschlegelsteinhausenbergerdorff^Hubert Blaine",
            "0123456789-0123456789",
            "19040801",
            "prone",
            "20260102",
            true};
}

/// As many lines as a caption can have.
std::vector<OverlayText> manyLines()
{
    auto lines = captionLines(longCaption(), 1234, 1999, wordsFor(Organ()));
    for (const char* words :
         {"window colon: 1500 / -200 HU", "m12  a sessile polyp behind a fold, which was seen on",
          "the way back alone, and does not move when the", "patient is turned; to be looked at again…"})
        lines.push_back({{}, words});
    return lines;
}

TEST(CaptionOfSlices, LeavesRoomForACloseUpThatNoTextTouches)
{
    for (const std::size_t left_out : {0U, 4U})
        for (const auto& [width, height] : kSizes) {
            SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
            auto lines = manyLines();
            lines.resize(lines.size() - left_out);
            const int w = width / 2 - 1, h = height / 2 - 1;
            const CaptionPanel panel = captionPanel(lines, w, h);
            EXPECT_EQ(overlapping(panel.overlay.texts), "");
            for (const Area& area : textAreas(panel.overlay)) {
                EXPECT_FALSE(touch(area, panel.close_up)) << "at " << area.y;
                EXPECT_TRUE(area.x >= 0 && area.right() <= w && area.bottom() <= h) << "at " << area.y;
            }
            EXPECT_LE(panel.close_up.bottom(), h);
            EXPECT_LE(panel.close_up.right(), w);
            if (width >= 500 && left_out > 0) {
                EXPECT_GE(panel.close_up.height, 0.3 * h);
            }
        }
}

TEST(CaptionOfSlices, LeavesAllBelowAShortCaptionToTheCloseUp)
{
    const CaptionPanel panel = captionPanel({{{}, "window colon: 1500 / -200 HU"}}, 340, 256);
    EXPECT_EQ(panel.close_up.width, 340);
    EXPECT_EQ(panel.close_up.bottom(), 256);
    EXPECT_GE(panel.close_up.height, 0.8 * 256);
}

TEST(CaptionOfSlices, SaysWhereThereWasMore)
{
    const auto lines = manyLines();
    const CaptionPanel tight = captionPanel(lines, 99, 99), roomy = captionPanel(lines, 599, 449);
    ASSERT_LT(tight.overlay.texts.size(), lines.size());
    EXPECT_TRUE(tight.overlay.texts.back().text.ends_with(" …"));
    EXPECT_EQ(tight.close_up.width, 0);
    EXPECT_EQ(roomy.overlay.texts.size(), lines.size());
    EXPECT_EQ(roomy.overlay.texts.back().text, lines.back().text);
}

struct Captions : test::ColonFixture {};
struct BandCaptions : Captions {};

TEST_F(Captions, OfTheViewFromInsideTouchNeitherLettersNorEachOther)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.caption = longCaption();
    request.look_at_mm = colon.polyp_mm;
    request.peel.preset = "biopsy";
    SnapshotResult place = placeOf(of, request);
    place.sees_target = false;
    for (const auto& [width, height] : kSizes) {
        request.width = width;
        request.height = height;
        EXPECT_EQ(overlapping(endoscopicOverlay(of, request, place).texts), "") << width << " x " << height;
    }
}

TEST(CaptionOfDirections, AboutTheEyeNeverTouchAndTheNearestIsThere)
{
    constexpr double kText_px = 14;
    for (int turn = 0; turn < 360; turn += 5)
        for (int tilt = -85; tilt <= 85; tilt += 10) {
            const double a = radians(turn), b = radians(tilt);
            const Vector3 forward{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
            const Pose pose{{0, 0, 0}, forward, uprightOn(forward, {0, 0, 1})};
            Overlay overlay;
            addTriad(overlay, {60, 60}, 2.7 * kText_px, pose, kText_px);
            EXPECT_EQ(overlapping(overlay.texts), "") << turn << " " << tilt;
            EXPECT_GE(overlay.texts.size(), 3U);
            EXPECT_EQ(overlay.texts.front().text.front(), lettersFor(-forward).front())
                << "what lies before the eye's back";
        }
}

/// A band's words: within the picture, whole, none over another.
TEST_F(BandCaptions, StandBesideEachOtherToTheEndOfEachRow)
{
    const PreparedScan of = scan();
    NoProgress quiet;
    const BandMap band = bandOf(of, quiet);
    for (const int width : {400, 640, 900, 1250})
        for (const double middle_mm : {0.0, 90.0, 200.0, 260.0, 333.0, 480.0})
            for (const bool from_caecum : {false, true}) {
                BandRequest request;
                request.width = width;
                request.height = 260;
                request.middle_mm = middle_mm;
                request.from_caecum = from_caecum;
                request.still = false;
                const BandPage page = bandPicture(of, band, request, quiet).page;
                const Overlay overlay = bandOverlay(of, band, page, request);
                std::vector<OverlayText> stations;
                for (const OverlayText& text : overlay.texts)
                    if (text.text.find(" cm") != std::string::npos && text.at.y < page.top_px + page.label_px)
                        stations.push_back(text);
                EXPECT_EQ(overlapping(stations), "") << width << " " << middle_mm;
                for (const OverlayText& text : stations) {
                    EXPECT_GE(text.at.x, 0) << text.text;
                    EXPECT_LE(text.at.x + textSize(text).width_px, width) << text.text;
                    EXPECT_GE(text.most_width_px, textSize(text).width_px) << text.text << " is cut";
                }
            }
}

void expectWholeText(const Overlay& overlay, double text_px)
{
    EXPECT_EQ(overlapping(overlay.texts), "");
    const std::vector<Area> areas = textAreas(overlay);
    for (std::size_t n = 0; n < areas.size(); ++n)  // an area has room for accents and tails
        EXPECT_GE(areas[n].height, 0.9 * 1.2 * text_px) << overlay.texts[n].text;
    EXPECT_TRUE(std::ranges::any_of(overlay.texts, [](const OverlayText& t) { return t.color == kWarningColor; }))
        << "lossy";
}

/// A view of the window that is small beside others.
struct CaptionsOfSmallViews : Captions, testing::WithParamInterface<int> {
    static constexpr double kText_px = 12;

    static Caption caption()
    {
        Caption of = longCaption();
        of.named = false;  // as in the window
        of.lossy = true;
        return of;
    }
};

TEST_P(CaptionsOfSmallViews, KeepTheTextsSizeInTheViewFromInside)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.caption = caption();
    request.text_px = kText_px;
    request.width = GetParam();
    std::size_t texts = 0;
    for (request.height = 140; request.height <= 400; request.height += 10) {
        SCOPED_TRACE(request.height);
        const Overlay overlay = endoscopicOverlay(of, request, placeOf(of, request));
        expectWholeText(overlay, kText_px);
        EXPECT_GE(overlay.texts.size(), texts) << "the more room the more is said";
        texts = overlay.texts.size();
    }
    EXPECT_GE(texts, 13U) << "four letters, five around the eye and more, place and direction";
}

TEST_P(CaptionsOfSmallViews, KeepTheTextsSizeWhereALineIsLongerThanTheViewIsWide)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.caption = caption();
    request.text_px = kText_px;
    request.width = GetParam();
    SnapshotResult place = placeOf(of, request);
    place.sees_target = false;  // "the marker lies behind the wall seen here"
    request.peel.preset = transferFunctions().front().name;
    for (request.height = 220; request.height <= 400; request.height += 20) {
        SCOPED_TRACE(request.height);
        const Overlay overlay = endoscopicOverlay(of, request, place);
        expectWholeText(overlay, kText_px);
        const std::vector<Area> areas = textAreas(overlay);
        for (const Area& text : areas)
            EXPECT_LE(text.x + text.width, request.width);
    }
}

TEST_P(CaptionsOfSmallViews, KeepTheTextsSizeInASlice)
{
    const PreparedScan of = scan();
    SliceRequest request;
    request.caption = caption();
    request.text_px = kText_px;
    request.window = of.windows().front();
    request.thick = {ThickSlice::Kind::minimum, 5};
    request.voxels_a_pixel = 1;
    for (int height = 140; height <= 400; height += 10)
        for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
            SCOPED_TRACE(height);
            request.plane = plane;
            request.view = sliceThrough(of.volume().grid, request.plane, {-123, -123, -123}, GetParam(), height, 300);
            expectWholeText(sliceOverlay(request, true), kText_px);
        }
}

INSTANTIATE_TEST_SUITE_P(Widths, CaptionsOfSmallViews, testing::Values(226, 285, 400, 520, 640));

TEST_F(Captions, OfTheViewFromInsideNameTheSegmentThatIsFlownThroughAndTheNextFromItsBorderOn)
{
    colon.write(folder / "parts");
    nlohmann::json scan_json;
    const ColonPartRanges parts{{ColonPart::rectum, 0, 80},
                                {ColonPart::sigmoid, 80, 150},
                                {ColonPart::descending, 150, 200},
                                {ColonPart::caecum, 200, 400}};
    scan_json["steps"]["quality"] = {{"version", 1},
                                     {"digest", ""},
                                     {"parameters", nlohmann::json::object()},
                                     {"result", {{"parts", toJson(parts)}}},
                                     {"seconds", 0},
                                     {"finished", ""}};
    replaceFile(folder / "parts" / "scan.json", scan_json.dump());
    const PreparedScan of = PreparedScan::open(folder / "parts");
    ASSERT_EQ(of.parts().size(), parts.size());
    const auto namedAt = [&](double station_mm, double text_px) {
        SnapshotRequest request;
        request.station_mm = station_mm;
        request.text_px = text_px;
        request.width = request.height = 700;
        const auto texts = endoscopicOverlay(of, request, placeOf(of, request)).texts;
        std::string named;
        for (const OverlayText& text : texts)
            for (const ColonPartRange& range : parts)
                if (text.text == nameOf(range.part))
                    named += text.text;
        return named;
    };
    for (const double text_px : {0.0, 13.0})  // of a picture that is kept, and in the window
        for (std::size_t n = 1; n < parts.size(); ++n) {
            const double border_mm = parts[n].from_mm;
            for (const double before_mm : {40.0, 5.0, 0.1})
                EXPECT_EQ(namedAt(border_mm - before_mm, text_px), nameOf(parts[n - 1].part)) << border_mm;
            for (const double behind_mm : {0.1, 5.0, 40.0})
                EXPECT_EQ(namedAt(border_mm + behind_mm, text_px), nameOf(parts[n].part)) << border_mm;
        }
}

TEST_F(Captions, OfMarkersInTheProjectionMakeRoomForTheOnesOfItsParts)
{
    const PreparedScan of = scan();
    SnapshotRequest request;
    request.width = request.height = 600;
    const OverviewGround ground = overviewGround(of, request);
    ASSERT_EQ(ground.names.size(), 2U) << "rectum and caecum";
    const SnapshotResult place = placeOf(of, request);
    for (const Area& name : ground.names)
        for (const Pixel at : {Pixel{name.x, name.bottom()}, name.centre(), Pixel{name.right() - 20, name.bottom()}}) {
            Marker marker;
            marker.position_mm = ground.view.pointAt(at);
            for (const char* id : {"m1", "m2"}) {
                marker.id = id;
                request.markers.push_back(marker);
            }
            const auto texts = overviewOverlay(ground, of, request, place).texts;
            for (const OverlayText& text : texts)
                for (const Area& taken : ground.names)
                    EXPECT_FALSE((text.text.starts_with("m1") || text.text.starts_with("m2")) &&
                                 touch(textArea(text), taken))
                        << at.x << ", " << at.y;
            ASSERT_EQ(texts[texts.size() - 2].text + texts.back().text, "m1m2");
            EXPECT_FALSE(touch(textArea(texts[texts.size() - 2]), textArea(texts.back()))) << "of one place";
            request.markers.clear();
        }
}

}  // namespace
}  // namespace vicon::viewer
