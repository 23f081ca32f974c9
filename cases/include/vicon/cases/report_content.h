#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/comparisons.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/core/quantity.h"

namespace vicon {

/// How far open a part of the colon is in one scan.
struct PartState {
    std::string scan_id;
    ColonPart part = ColonPart::rectum;
    Distension distension = Distension::good;
    bool by_reader = false;  ///< said by the reader; else measured
};

struct FindingWithFacts {
    Finding finding;
    FindingFacts facts;
};

/// All that is known for a case's report: what people said, and what follows from it.
struct ReadCase {
    CaseRecord record;
    std::vector<ScanRecord> scans;                    ///< of role "scan", and those with markers
    std::map<std::string, LumenOrigin> given_lumens;  ///< by scan: of those whose lumen another program made
    std::vector<Marker> markers;
    std::vector<FindingWithFacts> findings;
    std::vector<std::string> loose_markers;  ///< ids of those that belong to no finding
    Assessment assessment;
    std::vector<ComparedFinding> comparisons;  ///< of its findings with those of earlier reports, rejected ones too
    std::vector<PartState> parts;  ///< from the rectum, scan by scan; a part that was not measured is not listed
    Proposal<ColonCategory> colon_proposal;
    Proposal<ExtracolonicCategory> extracolonic_proposal;
};
ReadCase readCase(CaseStore& store, const std::string& case_id);
/// Of its scans: a signal where there is one of MR.
Quantity quantityOf(const ReadCase& read);
/// As it would be with another assessment.
ReadCase readCaseWith(CaseStore& store, const std::string& case_id, const Assessment& assessment);

/// The parts that are collapsed in every scan that says something of them.
std::vector<std::string> collapsedEverywhere(const std::vector<PartState>& parts);

/// As docs/dev/schemas/report.schema.json has it. The same case gives the same text.
nlohmann::json reportContent(const ReadCase& read);
/// Reads it back, as the report of a version that was kept is written anew in another form. Throws Error{bad_input}.
ReadCase readCaseFromContent(const nlohmann::json& content);

/// What a signature still lacks, a line each.
std::vector<std::string> missingForSignature(const ReadCase& read);

/// Throws Error{wrong_use} where a chosen category is not the proposed one and no reason is given.
void requireReasons(const ReadCase& read);

}  // namespace vicon
