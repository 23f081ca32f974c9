#include "vicon/cases/assessment.h"

#include "json_fields.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/error.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr EnumNames<Grade, 3> kGradeNames = {
    {{Grade::good, "good"}, {Grade::fair, "fair"}, {Grade::inadequate, "inadequate"}}};
constexpr EnumNames<Distension, 3> kDistensionNames = {
    {{Distension::good, "good"}, {Distension::limited, "limited"}, {Distension::collapsed, "collapsed"}}};

/// The texts of an assessment, by their keys.
constexpr std::pair<const char*, std::string Assessment::*> kTexts[] = {
    {"indication", &Assessment::indication},         {"technique", &Assessment::technique},
    {"comparison", &Assessment::comparison},         {"impression", &Assessment::impression},
    {"recommendation", &Assessment::recommendation},
};
constexpr std::pair<const char*, bool Assessment::*> kFlags[] = {
    {"inadequate", &Assessment::inadequate},
    {"priors_awaited", &Assessment::priors_awaited},
    {"extracolonic_limited", &Assessment::extracolonic_limited},
};
constexpr std::pair<const char*, std::optional<double> Assessment::*> kFigures[] = {
    {"dose_mgy_cm", &Assessment::dose_mgy_cm},
    {"reading_minutes", &Assessment::reading_minutes},
    {"coverage_percent", &Assessment::coverage_percent},
};

template <class Category>
void putChosen(json& out, const char* key, const std::optional<Chosen<Category>>& chosen)
{
    if (!chosen)
        return;
    out[key] = {{"category", nameOf(chosen->category)}, {"why", chosen->why}};
    putName(out[key], "proposed", chosen->proposed);
}

template <class Category>
std::optional<Chosen<Category>> chosenFrom(const json& from, const char* key, Category (*value_of)(const std::string&))
{
    if (!from.contains(key))
        return std::nullopt;
    return Chosen<Category>{value_of(from[key].at("category").get<std::string>()), from[key].value("why", ""),
                            named(from[key], "proposed", value_of)};
}

}  // namespace

std::string nameOf(Grade grade)
{
    return nameIn(kGradeNames, grade);
}

Grade gradeFrom(const std::string& name)
{
    return valueIn(kGradeNames, name, "a grade");
}

std::vector<std::string> gradeNames()
{
    return namesOf(kGradeNames);
}

std::string nameOf(Distension distension)
{
    return nameIn(kDistensionNames, distension);
}

Distension distensionFrom(const std::string& name)
{
    return valueIn(kDistensionNames, name, "distension");
}

std::vector<std::string> distensionNames()
{
    return namesOf(kDistensionNames);
}

json toJson(const Assessment& a)
{
    json out = json::object();
    for (const auto& [key, text] : kTexts)
        out[key] = a.*text;
    for (const auto& [key, flag] : kFlags)
        out[key] = a.*flag;
    for (const auto& [key, figure] : kFigures)
        putValue(out, key, a.*figure);
    putName(out, "preparation", a.preparation);
    putName(out, "tagging", a.tagging);
    out["distension"] = json::array();
    for (const PartDistension& d : a.distension)
        out["distension"].push_back(
            {{"scan", d.scan_id}, {"part", nameOf(d.part)}, {"distension", nameOf(d.distension)}});
    out["extracolonic"] = json::array();
    for (const ExtracolonicFinding& e : a.extracolonic)
        out["extracolonic"].push_back({{"organ", e.organ}, {"text", e.text}, {"category", nameOf(e.category)}});
    putChosen(out, "colon_category", a.colon_category);
    putChosen(out, "extracolonic_category", a.extracolonic_category);
    return out;
}

Assessment assessmentFromJson(const json& from)
{
    return understood("an assessment", [&] {
        Assessment a;
        for (const auto& [key, text] : kTexts)
            a.*text = from.value(key, "");
        for (const auto& [key, flag] : kFlags)
            a.*flag = from.value(key, false);
        for (const auto& [key, figure] : kFigures)
            a.*figure = number(from, key);
        a.preparation = named(from, "preparation", gradeFrom);
        a.tagging = named(from, "tagging", gradeFrom);
        for (const json& d : from.value("distension", json::array()))
            a.distension.push_back({d.at("scan").get<std::string>(), colonPartFrom(d.at("part").get<std::string>()),
                                    distensionFrom(d.at("distension").get<std::string>())});
        for (const json& e : from.value("extracolonic", json::array()))
            a.extracolonic.push_back({e.value("organ", ""), e.value("text", ""),
                                      extracolonicCategoryFrom(e.at("category").get<std::string>())});
        a.colon_category = chosenFrom(from, "colon_category", colonCategoryFrom);
        a.extracolonic_category = chosenFrom(from, "extracolonic_category", extracolonicCategoryFrom);
        return a;
    });
}

}  // namespace vicon
