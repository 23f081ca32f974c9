#include <array>
#include <cstdio>

#include "../case_tables.h"
#include "../command.h"
#include "../report_known.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

/// Texts that are taken as they are; an empty one takes the text away.
struct TextOption {
    const char* name;
    std::string Assessment::*field;
    const char* help;
};
constexpr std::array<TextOption, 5> kTexts = {{
    {"--indication", &Assessment::indication, "Why the study was made"},
    {"--technique", &Assessment::technique, "How it was made, where that is not the usual way"},
    {"--comparison", &Assessment::comparison, "Earlier studies that it was compared with"},
    {"--impression", &Assessment::impression, "The impression, in place of the one that follows from the findings"},
    {"--recommendation", &Assessment::recommendation, "The recommendation, in place of the usual one"},
}};
struct FlagOption {
    const char* name;
    bool Assessment::*field;
    const char* help;
};
constexpr std::array<FlagOption, 3> kFlags = {{
    {"--inadequate,!--no-inadequate", &Assessment::inadequate, "A lesion of 10 mm or more cannot be excluded"},
    {"--priors-awaited,!--no-priors-awaited", &Assessment::priors_awaited, "Earlier studies are awaited"},
    {"--extracolonic-limited,!--no-extracolonic-limited", &Assessment::extracolonic_limited,
     "What lies outside the colon cannot be judged"},
}};

struct AssessArguments {
    std::string case_id, preparation, tagging, dose, minutes, coverage;
    std::string colon, colon_why, extracolonic_category, extracolonic_why;
    std::array<std::string, kTexts.size()> texts;
    std::array<bool, kTexts.size()> text_given{};
    std::array<bool, kFlags.size()> flags{}, flag_given{};
    std::vector<std::string> distension, extracolonic;
    bool accept = false, no_extracolonic = false, fill = false;
};

/// "SCAN:PART=GRADE"; "measured" goes back to what was measured.
void takeDistension(CaseStore& store, const std::string& case_id, const std::string& text, Assessment& said)
{
    const auto colon = text.find(':'), equals = text.find('=');
    if (colon == std::string::npos || equals == std::string::npos || equals < colon)
        throw Error(ErrorCode::wrong_use, "'" + text + "' is not SCAN:PART=GRADE", "--distension",
                    "as in s0123456789:sigmoid=limited");
    const std::string part_name = text.substr(colon + 1, equals - colon - 1), grade = text.substr(equals + 1);
    const std::string scan_id = store.requireScan(case_id, text.substr(0, colon)).id;
    const ColonPart part = colonPartFrom(part_name);
    std::erase_if(said.distension, [&](const PartDistension& d) { return d.scan_id == scan_id && d.part == part; });
    if (grade != "measured")
        said.distension.push_back({scan_id, part, distensionFrom(grade)});
}

/// "E3:ORGAN:TEXT".
ExtracolonicFinding extracolonicFrom(const std::string& text)
{
    const auto first = text.find(':'), second = text.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
        throw Error(ErrorCode::wrong_use, "'" + text + "' is not CATEGORY:ORGAN:TEXT", "--extracolonic",
                    "as in 'E3:kidney:solid lesion of 12 mm'");
    return {text.substr(first + 1, second - first - 1), text.substr(second + 1),
            extracolonicCategoryFrom(text.substr(0, first))};
}

template <class Category>
void choose(std::optional<Chosen<Category>>& chosen, const Proposal<Category>& proposal, bool accept,
            const std::string& name, const std::string& why, Category (*value_of)(const std::string&))
{
    if (accept) {
        if (!proposal.category)
            throw Error(ErrorCode::bad_input, "no category can be proposed: " + proposal.reason);
        chosen = {*proposal.category, "", proposal.category};
    }
    if (!name.empty())
        chosen = {value_of(name), why, proposal.category};
    else if (!why.empty() && chosen)
        chosen = {chosen->category, why, proposal.category};
}

void takeFields(CaseStore& store, const std::string& case_id, const AssessArguments& a, Assessment& said)
{
    for (std::size_t n = 0; n < kTexts.size(); ++n)
        if (a.text_given[n])
            said.*kTexts[n].field = a.texts[n];
    for (std::size_t n = 0; n < kFlags.size(); ++n)
        if (a.flag_given[n])
            said.*kFlags[n].field = a.flags[n];
    if (!a.preparation.empty())
        said.preparation = gradeFrom(a.preparation);
    if (!a.tagging.empty())
        said.tagging = gradeFrom(a.tagging);
    if (!a.dose.empty())
        said.dose_mgy_cm = numberFrom(a.dose, "--dose", 0, 100'000);
    if (!a.minutes.empty())
        said.reading_minutes = numberFrom(a.minutes, "--minutes", 0, 1000);
    if (!a.coverage.empty())
        said.coverage_percent = numberFrom(a.coverage, "--coverage", 0, 100);
    for (const std::string& text : a.distension)
        takeDistension(store, case_id, text, said);
    if (a.no_extracolonic)
        said.extracolonic.clear();
    for (const std::string& text : a.extracolonic)
        said.extracolonic.push_back(extracolonicFrom(text));
}

int assess(Context& context, const AssessArguments& a)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = store.requireCase(a.case_id).id;
    const Assessment before = assessmentOf(store, case_id);
    Assessment said = before;
    takeFields(store, case_id, a, said);
    if (a.fill)
        fillIn(said, knownOf(store, case_id));
    ReadCase read = readCaseWith(store, case_id, said);
    choose(read.assessment.colon_category, read.colon_proposal, a.accept, a.colon, a.colon_why, colonCategoryFrom);
    choose(read.assessment.extracolonic_category, read.extracolonic_proposal, a.accept, a.extracolonic_category,
           a.extracolonic_why, extracolonicCategoryFrom);
    if (toJson(read.assessment) != toJson(before)) {
        context.require(Role::mark);
        requireCase(store, a.case_id, IdPart::whole);
        requireReasons(read);
        saveAssessment(store, case_id, before, read.assessment);
    }
    printFindings(context.json, store, readCase(store, case_id));
    return 0;
}

void declareCategories(CommandLine& command, AssessArguments& a)
{
    command.flag("--accept", a.accept, "Choose both categories as they are proposed");
    command.option("--c-rads", a.colon, "Choose this category of the colon: C0, C1, C2a, C2b, C3 or C4")
        .typeName("CATEGORY");
    command.option("--why", a.colon_why, "Why it is not the proposed one").typeName("TEXT").mayBeEmpty();
    command.option("--e-rads", a.extracolonic_category, "Choose this category outside the colon: E0, E1, E2, E3 or E4")
        .typeName("CATEGORY");
    command.option("--e-why", a.extracolonic_why, "Why it is not the proposed one").typeName("TEXT").mayBeEmpty();
    command.option("--extracolonic", a.extracolonic, "Add a finding outside the colon; may be given several times")
        .oneValueEach()
        .typeName("CATEGORY:ORGAN:TEXT");
    command.flag("--no-extracolonic", a.no_extracolonic, "Forget the findings outside the colon first");
}

}  // namespace

Subcommand assessCommand()
{
    return {"assess", "Say what holds for the whole study: preparation, distension, categories, impression",
            [](CommandLine& command) {
                auto a = std::make_shared<AssessArguments>();
                command.option("CASE", a->case_id, "The case's id, whole to change something").required();
                declareCategories(command, *a);
                std::vector<CommandOption> texts, flags;
                for (std::size_t n = 0; n < kTexts.size(); ++n)
                    texts.push_back(
                        command.option(kTexts[n].name, a->texts[n], kTexts[n].help).typeName("TEXT").mayBeEmpty());
                for (std::size_t n = 0; n < kFlags.size(); ++n)
                    flags.push_back(command.flag(kFlags[n].name, a->flags[n], kFlags[n].help));
                command.flag("--fill", a->fill,
                             "Take what the images say of indication, technique and dose, where nothing was said yet");
                command.option("--preparation", a->preparation, "good, fair or inadequate").typeName("GRADE");
                command.option("--tagging", a->tagging, "good, fair or inadequate").typeName("GRADE");
                command
                    .option("--distension", a->distension,
                            "Of a segment in a scan: good, limited or collapsed, in place of what was measured")
                    .oneValueEach()
                    .typeName("SCAN:PART=GRADE");
                command.option("--dose", a->dose, "Dose length product, mGy cm").typeName("NUMBER");
                command.option("--minutes", a->minutes, "How long the reading took").typeName("NUMBER");
                command.option("--coverage", a->coverage, "How much of the wall was reviewed").typeName("PERCENT");
                return [=](Context& context) {
                    for (std::size_t n = 0; n < texts.size(); ++n)
                        a->text_given[n] = texts[n].given();
                    for (std::size_t n = 0; n < flags.size(); ++n)
                        a->flag_given[n] = flags[n].given();
                    return assess(context, *a);
                };
            }};
}

}  // namespace vicon::app
