#include "vicon/report/coded_findings.h"

#include <algorithm>
#include <iterator>

#include "vicon/core/uid.h"

namespace vicon::report {
namespace {

Code millimetre()
{
    return ucum("mm", "millimeter");
}

/// Adds what is given.
class Facts {
public:
    CodedFacts out;

    void number(const Code& name, const std::optional<double>& value, const Code& unit)
    {
        if (value)
            out.numbers.push_back({name, *value, unit});
    }
    template <class Enum>
    void word(const Code& name, const std::optional<Enum>& value)
    {
        if (value)
            out.words.push_back({name, codeOf(*value)});
    }
    void wordIf(bool holds, const Code& name, const Code& value)
    {
        if (holds)
            out.words.push_back({name, value});
    }
    /// With the bounds of eight in ten.
    void change(const char* value, const std::string& of, const std::optional<Change>& change, const Code& unit)
    {
        if (!change)
            return;
        number(privateCode(value, of), change->about, unit);
        number(privateCode(std::string(value) + "_LEAST", of + ", least"), change->least, unit);
        number(privateCode(std::string(value) + "_MOST", of + ", most"), change->most, unit);
    }
    void text(const Code& name, const std::string& text)
    {
        if (!text.empty())
            out.texts.push_back({name, text});
    }
};

Code sizeSourceCode(SizeSource source)
{
    return privateCode(source == SizeSource::reader  ? "READER"
                       : source == SizeSource::plane ? "BEST_PLANE"
                       : source == SizeSource::slice ? "SLICE"
                                                     : "SURFACE",
                       nameOf(source));
}

}  // namespace

CodedFacts factsOfWhole(const FindingWithFacts& one)
{
    const auto& [finding, facts] = one;
    Facts f;
    f.number(sct("373197004", "Largest dimension"), facts.size_mm, millimetre());
    f.wordIf(facts.size_mm.has_value(), privateCode("SIZE_FROM", "Largest dimension taken from"),
             sizeSourceCode(facts.size_source));
    f.number(privateCode("HEIGHT", "Height above the wall"), finding.height_mm, millimetre());
    f.number(sct("118565006", "Volume"), finding.volume_ml, ucum("ml", "milliliter"));
    if (const auto& far = facts.endoscope) {
        const std::string name = "Estimated endoscope distance from anus";
        f.number(privateCode("ENDOSCOPE_ABOUT", name), far->about_mm, millimetre());
        f.number(privateCode("ENDOSCOPE_LEAST", name + ", least"), far->least_mm, millimetre());
        f.number(privateCode("ENDOSCOPE_MOST", name + ", most"), far->most_mm, millimetre());
    }
    f.word(privateCode("MORPHOLOGY", "Morphology"), finding.morphology);
    f.word(privateCode("ATTENUATION", "Attenuation"), finding.attenuation);
    f.word(privateCode("CONFIDENCE", "Confidence of the reader"), finding.confidence);
    const Code extent = privateCode("EXTENT", "Extent");
    f.wordIf(finding.narrows_lumen, extent, privateCode("NARROWS_LUMEN", "Narrows the lumen"));
    f.wordIf(finding.invades, extent, privateCode("INVADES", "Reaches beyond the wall"));
    f.text(dcm("121106", "Comment"), finding.note);
    return f.out;
}

CodedFacts factsOfSight(const FindingSight& sight)
{
    Facts f;
    f.number(dcm("112233", "Distance from anus"), sight.station_mm, millimetre());
    f.number(privateCode("FROM_CAECUM", "Distance from caecum"), sight.from_caecum_mm, millimetre());
    f.number(privateCode("FRACTION", "Fraction of the colon's length from the anus"), sight.fraction,
             ucum("1", "no units"));
    f.number(sight.size_in_slice ? privateCode("SIZE_IN_SLICE", "Distance between two points of a slice")
                                 : privateCode("SIZE_2D", "Largest diameter in the best plane"),
             sight.size_2d_mm, millimetre());
    f.number(privateCode("SIZE_3D", "Largest diameter on the surface"), sight.size_3d_mm, millimetre());
    f.number(privateCode("PART_FRACTION", "Fraction of the part's length from its anal end"), sight.part_fraction,
             ucum("1", "no units"));
    f.number(privateCode("OUTLINE_LEAST", "Diameter of the outline, least"), sight.size_least_mm, millimetre());
    f.number(privateCode("OUTLINE_MOST", "Diameter of the outline, most"), sight.size_most_mm, millimetre());
    f.number(privateCode("OUTLINE_HEIGHT", "Height of the outline"), sight.height_mm, millimetre());
    const Code millilitre = ucum("ml", "milliliter");
    f.number(privateCode("OUTLINE_VOLUME", "Volume of the outline"), sight.volume_ml, millilitre);
    f.number(privateCode("OUTLINE_VOLUME_LEAST", "Volume of the outline, least"), sight.volume_least_ml, millilitre);
    f.number(privateCode("OUTLINE_VOLUME_MOST", "Volume of the outline, most"), sight.volume_most_ml, millilitre);
    f.number(sct("112031007", "Mean density"), sight.mean_hu, ucum("[hnsf'U]", "Hounsfield unit"));
    if (sight.clock_hour)
        f.text(privateCode("CLOCK_FACE", "Clock-face position, seen from the anal side"),
               std::to_string(*sight.clock_hour) + " o'clock");
    return f.out;
}

CodedFacts factsOfComparison(const ComparedFinding& compared)
{
    const auto& [said, now, growth] = compared;
    const Code percent = ucum("%", "percent");
    Facts f;
    f.number(privateCode("PRIOR_SIZE", "Largest dimension then"), said.before.size_mm, millimetre());
    f.change("DIAMETER_CHANGE", "Change of the largest dimension", growth.diameter_mm, millimetre());
    f.change("VOLUME_CHANGE", "Change of the volume", growth.volume_percent, percent);
    f.change("VOLUME_A_YEAR", "Change of the volume a year", growth.percent_a_year, percent);
    f.number(privateCode("PRIOR_INTERVAL", "Years between the examinations"), growth.years, ucum("a", "year"));
    f.text(privateCode("PRIOR_NAME", "Tracking Identifier there"), said.prior_name);
    f.text(privateCode("PRIOR_DATE", "Date of the earlier examination"), said.before.date);
    f.text(privateCode("GROWTH", "Growth"), growthWords(growth));
    return f.out;
}

Code comparisonConcept()
{
    return privateCode("COMPARISON", "Comparison with an earlier report");
}

std::vector<ComparedFinding> confirmedComparisons(const ReadCase& read, const Finding& finding)
{
    std::vector<ComparedFinding> out;
    std::copy_if(read.comparisons.begin(), read.comparisons.end(), std::back_inserter(out),
                 [&](const ComparedFinding& one) { return one.said.confirmed && one.said.finding_id == finding.id; });
    return out;
}

CodedFacts factsOfStudy(const Assessment& said)
{
    Facts f;
    if (const auto& chosen = said.colon_category) {
        f.word(dcm("112222", "Colon Overall Assessment"), std::optional(chosen->category));
        f.text(privateCode("COLON_WHY", "Why not the proposed colon category"), chosen->why);
    }
    if (const auto& chosen = said.extracolonic_category) {
        f.word(extracolonicConcept(), std::optional(chosen->category));
        f.text(privateCode("EXTRACOLONIC_WHY", "Why not the proposed extracolonic category"), chosen->why);
    }
    f.word(privateCode("PREPARATION", "Preparation"), said.preparation);
    f.word(privateCode("TAGGING", "Tagging"), said.tagging);
    const Code limit = privateCode("LIMIT", "Limitation");
    f.wordIf(said.inadequate, limit, privateCode("INADEQUATE", "A lesion of 10 mm or more cannot be excluded"));
    f.wordIf(said.priors_awaited, limit, privateCode("PRIORS_AWAITED", "Prior studies are awaited"));
    f.wordIf(said.extracolonic_limited, limit,
             privateCode("EXTRACOLONIC_LIMITED", "What lies outside the colon cannot be judged"));
    f.number(dcm("113813", "CT Dose Length Product Total"), said.dose_mgy_cm, ucum("mGy.cm", "mGy.cm"));
    f.number(privateCode("COVERAGE", "Wall that was reviewed"), said.coverage_percent, ucum("%", "percent"));
    f.number(privateCode("READING_TIME", "Reading time"), said.reading_minutes, ucum("min", "minute"));
    return f.out;
}

std::string trackingName(const Finding& finding)
{
    return "Finding " + std::to_string(finding.number());
}

std::string trackingUid(const ReadCase& read, const Finding& finding)
{
    return uidFor("vicon finding\n" + read.record.study.uid + "\n" + finding.id);
}

}  // namespace vicon::report
