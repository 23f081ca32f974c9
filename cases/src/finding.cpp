#include "vicon/cases/finding.h"

#include <charconv>

#include "json_fields.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/error.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr EnumNames<FindingKind, 10> kKindNames = {{{FindingKind::polyp, "polyp"},
                                                    {FindingKind::mass, "mass"},
                                                    {FindingKind::indeterminate, "indeterminate"},
                                                    {FindingKind::lipoma, "lipoma"},
                                                    {FindingKind::stool, "stool"},
                                                    {FindingKind::diverticulum, "diverticulum"},
                                                    {FindingKind::inverted_diverticulum, "inverted diverticulum"},
                                                    {FindingKind::diverticular_stricture, "diverticular stricture"},
                                                    {FindingKind::valve, "valve"},
                                                    {FindingKind::other, "other"}}};
constexpr EnumNames<Morphology, 4> kMorphologyNames = {{{Morphology::sessile, "sessile"},
                                                        {Morphology::pedunculated, "pedunculated"},
                                                        {Morphology::flat, "flat"},
                                                        {Morphology::mass, "mass"}}};
constexpr EnumNames<Attenuation, 3> kAttenuationNames = {
    {{Attenuation::soft_tissue, "soft tissue"}, {Attenuation::fat, "fat"}, {Attenuation::mixed, "mixed"}}};
constexpr EnumNames<Confidence, 3> kConfidenceNames = {
    {{Confidence::low, "low"}, {Confidence::medium, "medium"}, {Confidence::high, "high"}}};

}  // namespace

std::string nameOf(FindingKind kind)
{
    return nameIn(kKindNames, kind);
}

FindingKind findingKindFrom(const std::string& name)
{
    return valueIn(kKindNames, name, "a finding");
}

std::vector<std::string> findingKindNames()
{
    return namesOf(kKindNames);
}

std::string nameOf(Morphology morphology)
{
    return nameIn(kMorphologyNames, morphology);
}

Morphology morphologyFrom(const std::string& name)
{
    return valueIn(kMorphologyNames, name, "a finding's morphology");
}

std::vector<std::string> morphologyNames()
{
    return namesOf(kMorphologyNames);
}

std::string nameOf(Attenuation attenuation)
{
    return nameIn(kAttenuationNames, attenuation);
}

Attenuation attenuationFrom(const std::string& name)
{
    return valueIn(kAttenuationNames, name, "a finding's attenuation");
}

std::vector<std::string> attenuationNames()
{
    return namesOf(kAttenuationNames);
}

std::string nameOf(Confidence confidence)
{
    return nameIn(kConfidenceNames, confidence);
}

Confidence confidenceFrom(const std::string& name)
{
    return valueIn(kConfidenceNames, name, "a reader's confidence");
}

std::vector<std::string> confidenceNames()
{
    return namesOf(kConfidenceNames);
}

int Finding::number() const
{
    int number = 0;
    if (id.size() > 1)
        std::from_chars(id.data() + 1, id.data() + id.size(), number);
    return number;
}

json toJson(const Finding& f)
{
    json out = {{"id", f.id},
                {"kind", nameOf(f.kind)},
                {"markers", f.markers},
                {"note", f.note},
                {"narrows_lumen", f.narrows_lumen},
                {"invades", f.invades},
                {"created", f.created},
                {"changed", f.changed}};
    putName(out, "morphology", f.morphology);
    putName(out, "attenuation", f.attenuation);
    putName(out, "confidence", f.confidence);
    putValue(out, "read_size_mm", f.read_size_mm);
    putValue(out, "height_mm", f.height_mm);
    putValue(out, "volume_ml", f.volume_ml);
    if (!f.pictures.empty())
        out["pictures"] = f.pictures;
    return out;
}

Finding findingFromJson(const json& from)
{
    return understood("a finding", [&] {
        Finding f;
        f.id = from.value("id", "");
        f.kind = findingKindFrom(from.at("kind").get<std::string>());
        f.markers = from.value("markers", std::vector<std::string>{});
        f.note = from.value("note", "");
        f.narrows_lumen = from.value("narrows_lumen", false);
        f.invades = from.value("invades", false);
        f.created = from.value("created", "");
        f.changed = from.value("changed", "");
        f.morphology = named(from, "morphology", morphologyFrom);
        f.attenuation = named(from, "attenuation", attenuationFrom);
        f.confidence = named(from, "confidence", confidenceFrom);
        f.read_size_mm = number(from, "read_size_mm");
        f.height_mm = number(from, "height_mm");
        f.volume_ml = number(from, "volume_ml");
        f.pictures = from.value("pictures", std::vector<std::string>{});
        return f;
    });
}

}  // namespace vicon
