#include "segment/verdict.h"

#include <algorithm>
#include <cmath>

#include "segment/constants.h"
#include "segment/field_of_view.h"

namespace vicon::steps {
namespace {

// A whole colon with gas holds 0.5 to 4 l and is 1.1 to 2.7 m long; these and the options segment.shortest_mm to
// .longest_mm leave room for short phantoms and colons that are half collapsed. No case recorded; of 40 crops of
// phantoms 101 to 105 that cut the colon, none was called a colon. Half and double leave the three cases
// (CONTRIBUTING.md) as they are.
constexpr double kNarrowest_mm = 6;       // largest radius
constexpr double kStumpConfidence = 0.5;  // that there is no colon where gas leaves the scan
constexpr double kLowestStart = 0.4;  // of the body's height in the scan: a rectum lies at the lower end of an abdomen

void doubt(Segmentation& result, double factor, const std::string& reason)
{
    result.confidence *= factor;
    note(result, reason);
}

std::string round(double value)
{
    return std::to_string(std::lround(value));
}

}  // namespace

void note(Segmentation& result, const std::string& what)
{
    result.reason += (result.reason.empty() ? "" : "; ") + what;
}

Segmentation organAbsent(const std::string& reason)
{
    Segmentation result;
    result.verdict = Verdict::absent;
    result.confidence = 0.9;
    result.reason = reason;
    return result;
}

void judgeSegmentation(Segmentation& result, const SegmentOptions& options, const Body& body, double lumen_cut_mm2)
{
    double length = 0, volume = 0, widest = 0;
    for (const LumenPiece& piece : result.plan.pieces) {
        length += piece.length_mm;
        volume += piece.volume_ml;
        widest = std::max(widest, piece.max_radius_mm);
    }
    for (const Bridge& bridge : result.plan.bridges)
        length += bridge.length_mm;
    const Point3 start = result.plan.pieces.front().rectal_end_mm, end = result.plan.pieces.back().caecal_end_mm;
    const double height = (start.z - body.lower_mm.z) / std::max(1.0, body.upper_mm.z - body.lower_mm.z);
    if (length < options.shortest_mm || volume < options.least_ml || widest < kNarrowest_mm) {
        result =
            organAbsent("the longest run of gas in the body is " + round(length) + " mm long, holds " + round(volume) +
                        " ml and is at most " + round(2 * widest) + " mm wide: too little for a colon");
        if (lumen_cut_mm2 > kLargestCut_mm2) {
            result.confidence = kStumpConfidence;
            note(result, "but it goes on beyond the end of the scan, over " + round(lumen_cut_mm2) +
                             " mm2: a colon may be cut off");
        }
        return;
    }
    result.confidence = 1;
    if (height > kLowestStart)
        doubt(result, 0.4, "the lowest piece of gas does not lie where a rectum does");
    if (length < options.usual_mm)
        doubt(result, 0.6, "only " + round(length) + " mm of colon were found");
    if (length > options.longest_mm)
        doubt(result, 0.6, "the colon found is " + round(length) + " mm long");
    if (end.x > (body.lower_mm.x + body.upper_mm.x) / 2)
        doubt(result, 0.6, "the far end does not lie on the patient's right, where the caecum is");
    for (const Bridge& bridge : result.plan.bridges)
        if (!bridge.certain)
            doubt(result, 0.7, "a bridge of " + round(bridge.length_mm) + " mm is uncertain: " + bridge.reason);
    if (lumen_cut_mm2 > kLargestCut_mm2)
        doubt(result, 0.45, "the lumen goes on beyond the end of the scan, over " + round(lumen_cut_mm2) + " mm2");
    if (result.confidence < 0.5 && bodyIsCut(body))
        note(result, "the field of view cuts the body");
    result.verdict = result.confidence >= 0.5 ? Verdict::found : Verdict::unsure;
    if (result.reason.empty())
        // Without a length: these are ways through voxels, longer than the skeleton's, which readers are shown.
        result.reason = "one run of gas and fluid from the rectum to the patient's right";
}

}  // namespace vicon::steps
