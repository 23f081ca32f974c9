#include <cstdio>

#include "../case_tables.h"
#include "../command.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct FindingArguments {
    std::string case_id, add, change, remove, markers;
    std::string kind, morphology, attenuation, confidence, size, height, volume, pictures, note;
    bool narrows = false, invades = false;
    bool note_given = false, narrows_given = false, invades_given = false, pictures_given = false;

    bool says() const
    {
        return !(kind + morphology + attenuation + confidence + size + height + volume).empty() || note_given ||
               narrows_given || invades_given || pictures_given;
    }
};

constexpr const char* kNone = "none";

/// "none" takes it away, nothing leaves it as it is.
template <class Value, class Read>
void take(std::optional<Value>& field, const std::string& text, Read read)
{
    if (text == kNone)
        field.reset();
    else if (!text.empty())
        field = read(text);
}

void takeFields(Finding& finding, const FindingArguments& a)
{
    const auto figure = [](const char* option, double most) {
        return [=](const std::string& text) { return numberFrom(text, option, 0, most); };
    };
    if (!a.kind.empty())
        finding.kind = findingKindFrom(a.kind);
    take(finding.morphology, a.morphology, morphologyFrom);
    take(finding.attenuation, a.attenuation, attenuationFrom);
    take(finding.confidence, a.confidence, confidenceFrom);
    take(finding.read_size_mm, a.size, figure("--size", 300));
    take(finding.height_mm, a.height, figure("--height", 300));
    take(finding.volume_ml, a.volume, figure("--volume", 2000));
    if (a.narrows_given)
        finding.narrows_lumen = a.narrows;
    if (a.invades_given)
        finding.invades = a.invades;
    if (a.pictures_given)
        finding.pictures = namesFrom(a.pictures);
    if (a.note_given)
        finding.note = a.note;
}

void requirePicturesOfItsMarkers(const Finding& finding)
{
    for (const std::string& id : finding.pictures)
        if (std::find(finding.markers.begin(), finding.markers.end(), id) == finding.markers.end())
            throw Error(ErrorCode::wrong_use, "marker " + id + " does not belong to the finding", "--pictures");
}

/// The change that the arguments ask for.
FindingEdit editFor(CaseStore& store, const std::string& case_id, const FindingArguments& a)
{
    FindingEdit edit;
    if (!a.remove.empty()) {
        edit.before = requireFinding(store, case_id, a.remove);
        return edit;
    }
    if (!a.change.empty())
        edit.before = requireFinding(store, case_id, a.change);
    edit.after = edit.before.value_or(Finding{});
    const std::string& markers = a.change.empty() ? a.add : a.markers;
    if (!markers.empty())
        edit.after->markers = withPartners(store, case_id, namesFrom(markers));
    takeFields(*edit.after, a);
    requirePicturesOfItsMarkers(*edit.after);
    return edit;
}

int finding(Context& context, const FindingArguments& a)
{
    const bool edits = !a.add.empty() || !a.change.empty() || !a.remove.empty();
    if (edits)
        context.require(Role::mark);
    CaseStore& store = context.existingStore();
    const std::string case_id = requireCase(store, a.case_id, edits ? IdPart::whole : IdPart::beginning).id;
    if (!edits && a.says())
        throw Error(ErrorCode::wrong_use, "which finding is meant is not said", case_id,
                    "name it with --change ID, or make one with --add MARKERS");
    if (edits)
        editFindings(store, case_id, {editFor(store, case_id, a)});
    printFindings(context.json, store, readCase(store, case_id));
    return 0;
}

std::string choices(const std::vector<std::string>& names)
{
    std::string out;
    for (const std::string& name : names)
        out += (out.empty() ? "" : ", ") + name;
    return out;
}

}  // namespace

Subcommand findingCommand()
{
    return {"finding", "List, add, change or remove the findings of a case", [](CommandLine& command) {
                auto a = std::make_shared<FindingArguments>();
                command.option("CASE", a->case_id, "The case's id, whole to change something").required();
                const auto add =
                    command.option("--add", a->add, "Add a finding that these markers and their partners show")
                        .typeName("MARKER,...");
                const auto change = command.option("--change", a->change, "Change this finding").typeName("ID");
                const auto remove = command.option("--remove", a->remove, "Remove this finding").typeName("ID");
                CommandOption(add).excludes(change).excludes(remove);
                CommandOption(change).excludes(remove);
                command.option("--markers", a->markers, "The markers that show it, in place of those it has")
                    .typeName("MARKER,...")
                    .needs(change);
                command.option("--kind", a->kind, "What it is: " + choices(findingKindNames())).typeName("KIND");
                command.option("--morphology", a->morphology, choices(morphologyNames()) + ", or none");
                command.option("--attenuation", a->attenuation, choices(attenuationNames()) + ", or none");
                command.option("--confidence", a->confidence, choices(confidenceNames()) + ", or none");
                command
                    .option("--size", a->size,
                            "The reader's size, which counts before measured ones; without the stalk; or none")
                    .typeName("MM");
                command.option("--height", a->height, "Of a flat one, above the wall; or none").typeName("MM");
                command.option("--volume", a->volume, "Its volume, or none").typeName("ML");
                const auto narrows =
                    command.flag("--narrows-lumen,!--no-narrows-lumen", a->narrows, "It compromises the lumen");
                const auto invades = command.flag("--invades,!--no-invades", a->invades, "It reaches beyond the wall");
                const auto pictures =
                    command.option("--pictures", a->pictures, "Show the pictures of these of its markers; none: of all")
                        .typeName("MARKER,...");
                const auto note = command.option("--note", a->note, "Further words").typeName("TEXT").mayBeEmpty();
                return [=](Context& context) {
                    a->note_given = note.given();
                    a->narrows_given = narrows.given();
                    a->invades_given = invades.given();
                    a->pictures_given = pictures.given();
                    return finding(context, *a);
                };
            }};
}

}  // namespace vicon::app
