#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/orders.h"
#include "vicon/core/options.h"
#include "vicon/ingest/modality_worklist.h"

namespace vicon::ingest {

/// Where the orders of cases are asked for, and which one belongs to a case.
struct OrderOptions {
    std::string peer;
    std::string modality = "CT";
    /// A study is done on the day that it was scheduled for, or, begun at night, on the next.
    int days = 1;
    /// Departments keep what was done in their worklists for some days.
    int ask_days = 3;
    double poll_s = 60;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("orders.peer", peer, "",
          "Peer whose modality worklist is asked for the accession number, referring physician and procedure of new "
          "cases; empty: nobody.");
        v("orders.modality", modality, "", "Modality of the scheduled steps; empty: any.");
        v("orders.days", days, "days",
          "A step of the patient belongs to a case without its study UID or accession number when it was scheduled for "
          "a day at most so far from the study's.",
          {0, 30});
        v("orders.ask_days", ask_days, "days", "A case is asked for until it and its study are so old.", {1, 365});
        v("orders.poll_s", poll_s, "s", "A case without an order is asked for so often.", {1, 86400});
    }
};

/// Which of a patient's scheduled steps a case was made by: the one of its study UID, else of its accession number,
/// else the only one of these days. One of another patient is never taken.
struct OrderChoice {
    std::optional<ScheduledStep> step;
    std::vector<std::string> doubts;  ///< what a person should look at, without a patient's name
};
OrderChoice chooseOrder(const CaseRecord& a_case, const std::vector<ScheduledStep>& steps, const OrderOptions& options);

/// What became of asking for a case's order.
struct OrderOutcome {
    std::optional<Order> order;        ///< nothing: the worklist has none
    std::vector<std::string> taken;    ///< what the case did not have: "accession number"
    std::vector<std::string> flagged;  ///< what a person should look at; said once with the case
};

/// Asks a peer for the order of a case and keeps it. What the case lacks is taken from it; what it has is compared,
/// stays, and is flagged where it differs. A case with a signed report stays as it is: what is new is flagged.
/// @throws Error{peer}, Error{wrong_use}, Error{not_found} when the case is gone, Error{database}, Error{store},
///         Error{cancelled}
OrderOutcome takeOrder(CaseStore& store, const std::string& case_id, const Peer& peer, const OrderOptions& options,
                       const std::string& our_ae_title, Progress& progress);

/// The cases that an order is sought for: young ones without one.
std::vector<CaseRecord> casesToAskFor(CaseStore& store, const OrderOptions& options);

}  // namespace vicon::ingest
