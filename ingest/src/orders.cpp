#include "vicon/ingest/orders.h"

#include <algorithm>
#include <chrono>

#include "dates.h"
#include "signed_version.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/patient_match.h"

namespace vicon::ingest {
namespace {

/// By the patient's ID, and by the accession number, so that one that went to another patient shows. Not every worklist
/// matches by Study Instance UID.
std::vector<ScheduledStep> stepsFor(const Peer& peer, const CaseRecord& c, const std::string& our_ae_title,
                                    Progress& progress)
{
    std::vector<ScheduledStep> steps;
    const auto add = [&](StudyQuery query) {
        query.modality.clear();
        std::ranges::copy(findScheduledSteps(peer, query, our_ae_title, progress), std::back_inserter(steps));
    };
    if (!c.patient.id.empty())
        add({.patient_id = c.patient.id});
    if (!c.study.accession_number.empty())
        add({.accession_number = c.study.accession_number});
    return steps;
}

bool sameText(const std::string& a, const std::string& b)
{
    return a == b;
}

bool samePerson(const std::string& a, const std::string& b)
{
    return sameNameAndBirth({.id = {}, .name = a, .birth_date = {}, .sex = {}},
                            {.id = {}, .name = b, .birth_date = {}, .sex = {}});
}

/// What a case and an order both may have.
struct Shared {
    const char* name;
    std::string Study::*in_case;
    std::string Order::*in_order;
    bool (*same)(const std::string&, const std::string&);
};
constexpr Shared kShared[] = {
    {"accession number", &Study::accession_number, &Order::accession_number, sameText},
    {"referring physician", &Study::referring_physician, &Order::referring_physician, samePerson},
};

/// Takes what the case lacks, and says what differs.
void compare(CaseRecord& c, const Order& order, bool is_signed, OrderOutcome& outcome)
{
    for (const Shared& field : kShared) {
        std::string& has = c.study.*field.in_case;
        const std::string& ordered = order.*field.in_order;
        if (ordered.empty() || (!has.empty() && field.same(has, ordered)))
            continue;
        std::string says = "the modality worklist has ";
        says.append(field.name).append(" '").append(ordered).append("', ");
        if (!has.empty()) {
            outcome.flagged.push_back(says.append("the images have '").append(has).append("'"));
        } else if (is_signed) {
            outcome.flagged.push_back(says.append("which came after the report was signed"));
        } else {
            has = ordered;
            outcome.taken.emplace_back(field.name);
        }
    }
}

/// Lines that were said before are not said again, also where a person took them away.
void addFlags(CaseStore& store, CaseRecord& c, const std::vector<std::string>& lines)
{
    for (const std::string& line : lines)
        if (!store.wasFlagged(c.id, line)) {
            store.flag(c.id, line);
            c.flags.push_back(line);
        }
}

}  // namespace

OrderOutcome takeOrder(CaseStore& store, const std::string& case_id, const Peer& peer, const OrderOptions& options,
                       const std::string& our_ae_title, Progress& progress)
{
    const auto steps = stepsFor(peer, store.requireCase(case_id), our_ae_title, progress);
    const StoreLock lock(store.folder(), progress);
    CaseRecord c = store.requireCase(case_id);
    const int version = signedVersion(store, case_id);
    OrderOutcome outcome;
    const OrderChoice choice = chooseOrder(c, steps, options);
    outcome.flagged = choice.doubts;
    if (choice.step) {
        const ScheduledStep& step = *choice.step;
        outcome.order = {
            peer.name, step.accession_number, step.referring_physician, step.procedure_id, step.procedure, step.reason,
            {}};
        compare(c, *outcome.order, version > 0, outcome);
    }
    addFlags(store, c, outcome.flagged);
    if (outcome.order)
        keepOrder(store, c, *outcome.order, [&] {
            if (signedVersion(store, case_id) != version)
                throw Error(ErrorCode::bad_input, "its report was signed meanwhile", case_id,
                            "ask for its order again");
        });
    return outcome;
}

std::vector<CaseRecord> casesToAskFor(CaseStore& store, const OrderOptions& options)
{
    std::string today = nowUtc().substr(0, std::string("2024-01-01").size());
    std::erase(today, '-');
    const std::string since = dateOf(dayOf(today) - std::chrono::days(options.ask_days));
    return casesWithoutOrder(store, since, since.substr(0, 4) + "-" + since.substr(4, 2) + "-" + since.substr(6, 2));
}

}  // namespace vicon::ingest
