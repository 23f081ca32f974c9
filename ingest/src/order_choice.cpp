#include <algorithm>
#include <cstdlib>
#include <set>
#include <tuple>

#include "dates.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/patient_match.h"

namespace vicon::ingest {
namespace {

using Steps = std::vector<ScheduledStep>;

template <class Condition>
Steps those(const Steps& steps, Condition condition)
{
    Steps some;
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(some), condition);
    return some;
}

/// One order may have several steps.
std::size_t countOrders(const Steps& steps)
{
    std::set<std::tuple<std::string, std::string>> orders;
    for (const ScheduledStep& step : steps)
        orders.emplace(step.accession_number, step.procedure_id);
    return orders.size();
}

void doubtOtherPatients(const CaseRecord& c, const Steps& steps, OrderChoice& choice)
{
    const auto is_of_another = [&](const ScheduledStep& step) { return !samePatient(c.patient, step.patient); };
    const auto has = [&](auto condition) {
        return std::any_of(steps.begin(), steps.end(),
                           [&](const ScheduledStep& step) { return is_of_another(step) && condition(step); });
    };
    if (has([&](const auto& step) {
            return step.study_uid == c.study.uid ||
                   (!c.study.accession_number.empty() && step.accession_number == c.study.accession_number);
        }))
        choice.doubts.emplace_back("the modality worklist has this study for another patient");
    else if (has([&](const auto& step) { return step.patient.id == c.patient.id; }))
        choice.doubts.emplace_back("the modality worklist has another patient under this patient ID");
}

}  // namespace

OrderChoice chooseOrder(const CaseRecord& c, const std::vector<ScheduledStep>& steps, const OrderOptions& options)
{
    OrderChoice choice;
    doubtOtherPatients(c, steps, choice);
    const Steps own = those(steps, [&](const auto& step) { return samePatient(c.patient, step.patient); });
    Steps fit = those(own, [&](const auto& step) { return step.study_uid == c.study.uid; });
    if (fit.empty() && !c.study.accession_number.empty())
        fit = those(own, [&](const auto& step) { return step.accession_number == c.study.accession_number; });
    if (fit.empty() && !c.study.date.empty())
        fit = those(own, [&](const auto& step) {
            return !step.date.empty() &&
                   std::abs((dayOf(step.date) - dayOf(c.study.date)).count()) <= std::chrono::days::rep(options.days) &&
                   (options.modality.empty() || step.modality.empty() || step.modality == options.modality);
        });
    if (countOrders(fit) == 1)
        choice.step = fit.front();
    else if (!fit.empty())
        choice.doubts.push_back("the modality worklist has " + std::to_string(countOrders(fit)) +
                                " orders that this study may belong to");
    return choice;
}

}  // namespace vicon::ingest
