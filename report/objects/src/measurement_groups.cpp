#include "measurement_groups.h"

#include <algorithm>

#include "vicon/core/uid.h"

namespace vicon::report {
namespace {

constexpr auto kContains = DSRTypes::RT_contains;

Code millimetre()
{
    return ucum("mm", "millimeter");
}

void numberWhereGiven(SrTree& tree, const Code& concept_name, const std::optional<double>& value, const Code& unit)
{
    if (value)
        tree.number(concept_name, *value, unit);
}

template <class Enum>
void codeWhereGiven(SrTree& tree, const Code& concept_name, const std::optional<Enum>& value)
{
    if (value)
        tree.code(kContains, concept_name, codeOf(*value));
}

void addWhole(SrTree& tree, const FindingWithFacts& one)
{
    const auto& [finding, facts] = one;
    if (facts.size_mm) {
        tree.number(sct("373197004", "Largest dimension"), *facts.size_mm, millimetre());
        tree.code(kContains, ours("SIZE_FROM", "Largest dimension taken from"),
                  ours(facts.size_source == SizeSource::reader  ? "READER"
                       : facts.size_source == SizeSource::plane ? "BEST_PLANE"
                                                                : "SURFACE",
                       nameOf(facts.size_source)));
    }
    numberWhereGiven(tree, ours("HEIGHT", "Height above the wall"), finding.height_mm, millimetre());
    numberWhereGiven(tree, sct("118565006", "Volume"), finding.volume_ml, ucum("ml", "milliliter"));
    if (facts.endoscope) {
        tree.number(ours("ENDOSCOPE_ABOUT", "Estimated endoscope distance from anus"), facts.endoscope->about_mm,
                    millimetre());
        tree.number(ours("ENDOSCOPE_LEAST", "Estimated endoscope distance from anus, least"), facts.endoscope->least_mm,
                    millimetre());
        tree.number(ours("ENDOSCOPE_MOST", "Estimated endoscope distance from anus, most"), facts.endoscope->most_mm,
                    millimetre());
    }
    codeWhereGiven(tree, ours("MORPHOLOGY", "Morphology"), finding.morphology);
    codeWhereGiven(tree, ours("ATTENUATION", "Attenuation"), finding.attenuation);
    codeWhereGiven(tree, ours("CONFIDENCE", "Confidence of the reader"), finding.confidence);
    if (finding.narrows_lumen)
        tree.code(kContains, ours("EXTENT", "Extent"), ours("NARROWS_LUMEN", "Narrows the lumen"));
    if (finding.invades)
        tree.code(kContains, ours("EXTENT", "Extent"), ours("INVADES", "Reaches beyond the wall"));
    tree.textWhereGiven(dcm("121106", "Comment"), finding.note);
}

void addSight(SrTree& tree, const ReadCase& read, const FindingSight& sight, const MarkerImages& images)
{
    const auto scan =
        std::find_if(read.scans.begin(), read.scans.end(), [&](const ScanRecord& s) { return s.id == sight.scan_id; });
    tree.text(kContains, ours("MARKER", "Marker"), sight.marker_id);
    if (scan != read.scans.end() && !scan->series.frame_of_reference_uid.empty())
        tree.point(dcm("111010", "Center"), sight.position_mm, scan->series.frame_of_reference_uid);
    if (const auto image = images.find(sight.marker_id); image != images.end()) {
        const Code source = dcm("121112", "Source of Measurement");
        tree.image(&source, image->second);
    }
    tree.number(dcm("112233", "Distance from anus"), sight.station_mm, millimetre());
    tree.number(ours("FROM_CAECUM", "Distance from caecum"), sight.from_caecum_mm, millimetre());
    tree.number(ours("FRACTION", "Fraction of the colon's length from the anus"), sight.fraction,
                ucum("1", "no units"));
    numberWhereGiven(tree, ours("SIZE_2D", "Largest diameter in the best plane"), sight.size_2d_mm, millimetre());
    numberWhereGiven(tree, ours("SIZE_3D", "Largest diameter on the surface"), sight.size_3d_mm, millimetre());
    numberWhereGiven(tree, sct("112031007", "Mean density"), sight.mean_hu, ucum("[hnsf'U]", "Hounsfield unit"));
    if (sight.clock_hour)
        tree.text(kContains, ours("CLOCK_FACE", "Clock-face position, seen from the anal side"),
                  std::to_string(*sight.clock_hour) + " o'clock");
}

void addGroup(SrTree& tree, const ReadCase& read, const FindingWithFacts& one, const FindingSight* sight,
              const MarkerImages& images)
{
    const Finding& finding = one.finding;
    tree.container(kContains, dcm("125007", "Measurement Group"), "1501", [&] {
        tree.text(DSRTypes::RT_hasObsContext, dcm("112039", "Tracking Identifier"),
                  "Finding " + std::to_string(finding.number()));
        tree.uid(DSRTypes::RT_hasObsContext, dcm("112040", "Tracking Unique Identifier"),
                 uidFor("vicon finding\n" + read.record.study.uid + "\n" + finding.id));
        tree.code(kContains, dcm("121071", "Finding"), codeOf(finding.kind));
        const auto part = sight ? sight->part : std::nullopt;
        if (part)
            tree.code(DSRTypes::RT_hasConceptMod, sct("363698007", "Finding Site"), codeOf(*part));
        if (sight)
            addSight(tree, read, *sight, images);
        if (!sight || sight == one.facts.lead())
            addWhole(tree, one);
    });
}

}  // namespace

void addFindings(SrTree& tree, const ReadCase& read, const MarkerImages& images)
{
    for (const FindingWithFacts& one : read.findings) {
        for (const FindingSight& sight : one.facts.sights)
            addGroup(tree, read, one, &sight, images);
        if (one.facts.sights.empty())
            addGroup(tree, read, one, nullptr, images);
    }
}

void addCentrelines(SrTree& tree, const std::vector<Centreline>& centrelines)
{
    for (const auto& [scan, points_mm, length_mm] : centrelines)
        tree.container(kContains, dcm("125007", "Measurement Group"), "1501", [&] {
            tree.text(DSRTypes::RT_hasObsContext, dcm("112039", "Tracking Identifier"), "Centerline of " + scan.id);
            tree.uid(DSRTypes::RT_hasObsContext, dcm("112040", "Tracking Unique Identifier"),
                     uidFor("vicon centreline\n" + scan.series.uid));
            tree.code(kContains, dcm("121071", "Finding"), sct("71854001", "Colon"));
            tree.line(dcm("130490", "Centerline"), points_mm, scan.series.frame_of_reference_uid);
            tree.number(dcm("121211", "Path length"), length_mm, millimetre());
        });
}

}  // namespace vicon::report
