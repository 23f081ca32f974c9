#include <cstdio>

#include "../command.h"
#include "../priors.h"
#include "../text_table.h"
#include "vicon/cases/printed.h"
#include "vicon/cases/prior_match.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct PriorArguments {
    std::string case_id, confirm, reject, take_back;
};

std::string sizeOf(const PriorFinding& finding)
{
    if (!finding.size_mm)
        return "-";
    return formatNumber(*finding.size_mm, 1) + (finding.size_from.empty() ? "" : " (" + finding.size_from + ")");
}

std::string siteOf(const PriorFinding& finding)
{
    const PriorSight* lead = finding.lead();
    return lead && lead->part ? nameOf(*lead->part) : lead && !lead->site.empty() ? lead->site : "-";
}

std::string withinPart(const PriorFinding& finding)
{
    const PriorSight* lead = finding.lead();
    return lead && lead->part_fraction ? formatNumber(100 * *lead->part_fraction, 0) + " %" : "-";
}

/// "f1, 12 mm towards the caecum by fraction inside the sigmoid", and how sure.
std::string matchOf(const PriorMatch& match, const std::vector<Comparison>& said)
{
    std::string out;
    for (const Comparison& c : said)
        if (c.report_uid == match.report_uid && c.prior_uid == match.prior_uid)
            out += (out.empty() ? "" : "; ") + c.finding_id + (c.confirmed ? " confirmed" : " rejected");
    if (!out.empty())
        return out;
    for (const PriorCandidate& candidate : match.candidates)
        out += (out.empty() ? "" : " or ") + candidate.finding_id + " (" + formatNumber(candidate.off_mm, 0) + " mm)";
    if (out.empty())
        return "none within the window";
    return (match.alone ? "proposed: " : "ambiguous: ") + out + ", by " + match.candidates.front().by;
}

struct Listing {
    PriorList priors;
    std::vector<std::vector<PriorMatch>> matches;  ///< of each report
    ReadCase read;
    std::vector<Comparison> said;
};

Listing listingOf(Context& context, const std::string& case_id)
{
    CaseStore& store = context.existingStore();
    Listing out{priorsOf(store, case_id), {}, readCase(store, case_id), comparisons(store, case_id)};
    const auto options = context.config().get<PriorOptions>();
    const auto colons = colonsOf(store, case_id);
    for (const PriorReport& report : out.priors.reports)
        out.matches.push_back(matchFindings(report, out.read.findings, colons, options));
    return out;
}

void printText(const Listing& listing)
{
    for (std::size_t n = 0; n < listing.priors.reports.size(); ++n) {
        const PriorReport& report = listing.priors.reports[n];
        std::printf("%zu: %s%s%s\n", n + 1, inBrief(report).c_str(), report.is_signed ? "" : ", not signed",
                    report.case_id.empty() ? "" : (", case " + report.case_id).c_str());
        std::vector<std::vector<std::string>> rows;
        for (std::size_t f = 0; f < report.findings.size(); ++f) {
            const PriorFinding& finding = report.findings[f];
            rows.push_back({std::to_string(n + 1) + "." + std::to_string(f + 1), finding.name, finding.what,
                            sizeOf(finding), siteOf(finding), withinPart(finding),
                            matchOf(listing.matches[n][f], listing.said)});
        }
        if (!rows.empty())
            std::printf("%s", formatTable({"ID", "NAME", "WHAT", "SIZE MM", "SITE", "IN IT", "TODAY"}, rows).c_str());
        for (const std::string& line : report.not_read)
            std::printf("not read of it: %s\n", line.c_str());
    }
    if (listing.priors.reports.empty())
        std::printf("no earlier report of this patient\n");
    for (const ComparedFinding& compared : listing.read.comparisons)
        if (compared.said.confirmed)
            std::printf("finding %s: %s\n", compared.said.finding_id.c_str(), growthWords(compared.growth).c_str());
    for (const std::string& line : listing.priors.left_out)
        std::printf("left out: %s\n", line.c_str());
}

void printJson(const Listing& listing)
{
    nlohmann::json out = {{"priors", nlohmann::json::array()},
                          {"comparisons", reportContent(listing.read).at("comparisons")},
                          {"left_out", listing.priors.left_out}};
    for (std::size_t n = 0; n < listing.priors.reports.size(); ++n) {
        nlohmann::json report = toJson(listing.priors.reports[n]);
        for (std::size_t f = 0; f < listing.matches[n].size(); ++f) {
            const PriorMatch& match = listing.matches[n][f];
            nlohmann::json candidates = nlohmann::json::array();
            for (const PriorCandidate& c : match.candidates)
                candidates.push_back({{"finding", c.finding_id}, {"off_mm", c.off_mm}, {"by", c.by}});
            report["findings"][f]["id"] = std::to_string(n + 1) + "." + std::to_string(f + 1);
            report["findings"][f]["candidates"] = candidates;
            report["findings"][f]["alone"] = match.alone;
        }
        out["priors"].push_back(std::move(report));
    }
    std::printf("%s\n", out.dump(2).c_str());
}

/// "f1=2.1": a finding of today, and one of the list.
struct Pair {
    std::string finding_id;
    const PriorReport* report;
    const PriorFinding* prior;
};

Pair pairFrom(CaseStore& store, const std::string& case_id, const PriorList& priors, const std::string& text)
{
    const std::size_t equals = text.find('='), dot = text.rfind('.');
    if (equals == std::string::npos || dot == std::string::npos || dot < equals)
        throw Error(ErrorCode::wrong_use, "not a finding and one of an earlier report", "'" + text + "'",
                    "write f1=1.2, as 'vicon priors " + case_id + "' numbers them");
    const PriorReport& report = requirePrior(priors, text.substr(equals + 1, dot - equals - 1));
    const std::string which = text.substr(dot + 1);
    for (std::size_t n = 0; n < report.findings.size(); ++n)
        if (std::to_string(n + 1) == which)
            return {requireFinding(store, case_id, text.substr(0, equals)).id, &report, &report.findings[n]};
    throw Error(ErrorCode::not_found, "the earlier report has no such finding", "'" + text + "'",
                "'vicon priors " + case_id + "' lists them");
}

void say(CaseStore& store, const std::string& case_id, const PriorArguments& a)
{
    const PriorList priors = priorsOf(store, case_id);
    const std::string& text = !a.confirm.empty() ? a.confirm : !a.reject.empty() ? a.reject : a.take_back;
    const Pair pair = pairFrom(store, case_id, priors, text);
    const auto before = findComparison(store, case_id, pair.finding_id, pair.report->sop_uid, pair.prior->uid);
    if (!a.take_back.empty()) {
        if (!before)
            throw Error(ErrorCode::not_found, "nothing was said of these two", "'" + text + "'");
        editComparison(store, case_id, before, std::nullopt);
        return;
    }
    Comparison after = comparisonWith(pair.finding_id, *pair.report, *pair.prior, imagedScans(store, *pair.report));
    after.confirmed = !a.confirm.empty();
    editComparison(store, case_id, before, after);
}

int priors(Context& context, const PriorArguments& a)
{
    CaseStore& store = context.existingStore();
    const bool says = !(a.confirm + a.reject + a.take_back).empty();
    const std::string case_id = requireCase(store, a.case_id, says ? IdPart::whole : IdPart::beginning).id;
    if (says)
        say(store, case_id, a);
    const Listing listing = listingOf(context, case_id);
    if (context.json)
        printJson(listing);
    else
        printText(listing);
    return 0;
}

}  // namespace

Subcommand priorsCommand()
{
    return {
        "priors", "List earlier reports of the patient, and compare findings with theirs", [](CommandLine& command) {
            auto a = std::make_shared<PriorArguments>();
            command.option("CASE", a->case_id, "The case's id, whole to change something").required();
            const auto confirm =
                command.option("--confirm", a->confirm, "These two are one thing; growth follows").typeName("F=N.M");
            const auto reject = command.option("--reject", a->reject, "These two are not").typeName("F=N.M");
            const auto take_back =
                command.option("--take-back", a->take_back, "Forget what was said of these two").typeName("F=N.M");
            CommandOption(confirm).excludes(reject).excludes(take_back);
            CommandOption(reject).excludes(take_back);
            return [a](Context& context) { return priors(context, *a); };
        }};
}

}  // namespace vicon::app
