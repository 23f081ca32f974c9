#include "code_reading.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

#include "vicon/report/codes.h"

namespace vicon::report {
namespace {

/// The value whose code this is.
template <class Enum>
std::optional<Enum> byCode(const CodedConcept& code, const std::vector<std::string>& names,
                           Enum (*value_of)(const std::string&))
{
    for (const std::string& name : names) {
        const Enum value = value_of(name);
        if (const Code known = codeOf(value); known.value == code.value && known.scheme == code.scheme)
            return value;
    }
    return std::nullopt;
}

template <class Enum>
struct Words {
    const char* words;
    Enum value;
};

/// The first whose words are among these.
template <class Enum, std::size_t N>
std::optional<Enum> byWords(const CodedConcept& code, const Words<Enum> (&table)[N])
{
    std::string said = code.meaning;
    std::transform(said.begin(), said.end(), said.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    for (const auto& [words, value] : table)
        if (said.find(words) != std::string::npos)
            return value;
    return std::nullopt;
}

constexpr Words<ColonPart> kSites[] = {
    {"rectosigmoid", ColonPart::sigmoid},
    {"rectum", ColonPart::rectum},
    {"sigmoid", ColonPart::sigmoid},
    {"splenic flexure", ColonPart::splenic_flexure},
    {"hepatic flexure", ColonPart::hepatic_flexure},
    {"descending", ColonPart::descending},
    {"transverse", ColonPart::transverse},
    {"ascending", ColonPart::ascending},
    {"cecum", ColonPart::caecum},
    {"caecum", ColonPart::caecum},
};
constexpr Words<FindingKind> kKinds[] = {
    {"polyp", FindingKind::polyp},   {"mass", FindingKind::mass},     {"tumor", FindingKind::mass},
    {"tumour", FindingKind::mass},   {"neoplasm", FindingKind::mass}, {"carcinoma", FindingKind::mass},
    {"lipoma", FindingKind::lipoma}, {"feces", FindingKind::stool},
};

std::vector<std::string> partNames()
{
    std::vector<std::string> names;
    for (int n = 0; n <= int(ColonPart::caecum); ++n)
        names.push_back(nameOf(ColonPart(n)));
    return names;
}

const std::vector<std::string> kColonCategories{"C0", "C1", "C2a", "C2b", "C3", "C4"};
const std::vector<std::string> kExtracolonicCategories{"E0", "E1/E2", "E3", "E4"};

/// Fills in an assessment, item by item.
class StudyReader {
public:
    Assessment said;

    void read(const ContentItem& item)
    {
        if (item.type == "CONTAINER" && item.name.value == "EXTRACOLONIC_FINDING")
            return readExtracolonic(item);
        if (item.type == "CONTAINER" && item.name.value == "125007")
            return;  // a finding
        if (item.type == "TEXT")
            readText(item);
        else if (item.type == "CODE")
            readCode(item);
        else if (item.type == "NUM")
            readNumber(item);
        for (const ContentItem& child : item.children)
            read(child);
    }
    /// Why another category than the proposed one was chosen stands beside it.
    void giveReasons()
    {
        if (said.colon_category)
            said.colon_category->why = colon_why_;
        if (said.extracolonic_category)
            said.extracolonic_category->why = extracolonic_why_;
    }

private:
    void readText(const ContentItem& item)
    {
        const std::pair<const char*, std::string*> places[] = {
            {"18785-6", &said.indication},
            {"121065", &said.technique},
            {"18834-2", &said.comparison},
            {"121073", &said.impression},
            {"121075", &said.recommendation},
            {"COLON_WHY", &colon_why_},
            {"EXTRACOLONIC_WHY", &extracolonic_why_},
        };
        for (const auto& [code, text] : places)
            if (item.name.value == code)
                *text = item.text;
    }
    void readCode(const ContentItem& item)
    {
        if (item.name.value == "112222") {
            if (const auto category = byCode(item.code, kColonCategories, colonCategoryFrom))
                said.colon_category = {*category, {}, {}};
        } else if (item.name.value == extracolonicConcept().value) {
            if (const auto category = byCode(item.code, kExtracolonicCategories, extracolonicCategoryFrom))
                said.extracolonic_category = {*category, {}, {}};
        } else if (item.name.value == "PREPARATION")
            said.preparation = byCode(item.code, gradeNames(), gradeFrom);
        else if (item.name.value == "TAGGING")
            said.tagging = byCode(item.code, gradeNames(), gradeFrom);
        else if (item.name.value == "LIMIT") {
            said.inadequate |= item.code.value == "INADEQUATE";
            said.priors_awaited |= item.code.value == "PRIORS_AWAITED";
            said.extracolonic_limited |= item.code.value == "EXTRACOLONIC_LIMITED";
        }
    }
    void readNumber(const ContentItem& item)
    {
        constexpr double kAny = std::numeric_limits<double>::max();
        const std::tuple<const char*, std::optional<double>*, double> places[] = {
            {"113813", &said.dose_mgy_cm, kAny},
            {"113838", &said.dose_mgy_cm, kAny},  // DLP of one event, and of reports of version 0.1 the whole
            {"COVERAGE", &said.coverage_percent, 100},
            {"READING_TIME", &said.reading_minutes, kAny}};
        for (const auto& [code, number, most] : places)
            if (item.name.value == code && item.number && *item.number >= 0 && *item.number <= most)
                *number = item.number;
    }
    void readExtracolonic(const ContentItem& item)
    {
        ExtracolonicFinding finding;
        for (const ContentItem& child : item.children)
            if (child.name.value == "ORGAN")
                finding.organ = child.text;
            else if (child.name.value == "121071")
                finding.text = child.text;
            else if (const auto category = byCode(child.code, kExtracolonicCategories, extracolonicCategoryFrom))
                finding.category = *category;
        said.extracolonic.push_back(finding);
    }

    std::string colon_why_, extracolonic_why_;
};

}  // namespace

bool isSite(const CodedConcept& name)
{
    return name.value == findingSiteConcept().value || name.value == "G-C0E3";
}

std::optional<FindingKind> findingKindOf(const CodedConcept& code)
{
    const auto known = byCode(code, findingKindNames(), findingKindFrom);
    return known ? known : byWords(code, kKinds);
}

std::optional<ColonPart> colonPartOf(const CodedConcept& code)
{
    const auto known = byCode(code, partNames(), colonPartFrom);
    return known ? known : byWords(code, kSites);
}

std::optional<Morphology> morphologyOf(const CodedConcept& code)
{
    return byCode(code, morphologyNames(), morphologyFrom);
}

std::optional<Attenuation> attenuationOf(const CodedConcept& code)
{
    return byCode(code, attenuationNames(), attenuationFrom);
}

std::optional<Confidence> confidenceOf(const CodedConcept& code)
{
    return byCode(code, confidenceNames(), confidenceFrom);
}

std::optional<Distension> distensionOf(const CodedConcept& code)
{
    return byCode(code, distensionNames(), distensionFrom);
}

std::optional<int> hourFrom(const std::string& text)
{
    int hour = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), hour);
    return problem == std::errc() && hour >= 1 && hour <= 12 ? std::optional(hour) : std::nullopt;
}

Assessment assessmentFrom(const ContentItem& root)
{
    StudyReader reader;
    reader.read(root);
    reader.giveReasons();
    return reader.said;
}

}  // namespace vicon::report
