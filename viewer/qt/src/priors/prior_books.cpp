#include "priors/prior_books.h"

#include <algorithm>

#include "vicon/cases/placing.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr const char* kPage = "page";

std::vector<PriorImages> imagesOf(CaseStore& store, const PriorList& list)
{
    std::vector<PriorImages> out;
    for (const PriorReport& report : list.reports) {
        const auto known = store.findCaseByStudy(report.study.uid);
        const bool listed = std::any_of(out.begin(), out.end(),
                                        [&](const PriorImages& one) { return known && one.record.id == known->id; });
        if (!known || listed)
            continue;
        for (const ScanRecord& scan : store.scans(known->id))
            if (const auto folder = store.scanFolder(known->id, scan.id);
                scan.role == ScanRole::scan && isPrepared(folder))
                out.push_back({*known, scan, folder});
    }
    return out;
}

const PriorReport& reportIn(const PriorPage& page, const std::string& report_uid)
{
    for (const PriorReport& report : page.list.reports)
        if (report.sop_uid == report_uid)
            return report;
    throw Error(ErrorCode::not_found, "this report is no longer there", report_uid);
}

}  // namespace

std::vector<const ComparedFinding*> PriorPage::saidOf(const std::string& report_uid, const std::string& prior_uid) const
{
    std::vector<const ComparedFinding*> out;
    for (const ComparedFinding& one : read.comparisons)
        if (one.said.report_uid == report_uid && one.said.prior_uid == prior_uid)
            out.push_back(&one);
    return out;
}

PriorBooks::PriorBooks(const ReadingServices& services, std::string case_id, QObject* parent)
    : QObject(parent), services_(services.priors), case_id_(std::move(case_id)), store_(this, services.store)
{
    connect(store_.worker(), &Worker::failed, this, &PriorBooks::warned);
}

PriorPage PriorBooks::pageOf(CaseStore& store, const Progress& wanted) const
{
    PriorPage page{.list = services_.list(store, case_id_),
                   .colons = colonsOf(store, case_id_),
                   .read = readCase(store, case_id_),
                   .open = reportStatus(store, case_id_).open()};
    for (const PriorReport& report : page.list.reports) {
        wanted.check();
        page.matches.push_back(matchFindings(report, page.read.findings, page.colons, services_.options));
    }
    page.images = imagesOf(store, page.list);
    return page;
}

void PriorBooks::change(const QString& done, Change change)
{
    store_.giveUp(kPage);  // it follows
    store_.postAlways(
        [this, done, change = std::move(change)](OwnStore& store, const Progress& wanted) -> Worker::Work {
            std::string trouble;
            try {
                change(store(), pageOf(store(), wanted));
            } catch (const std::exception& e) {
                trouble = e.what();
            }
            return [this, done, trouble, page = pageOf(store(), wanted)] {
                emit shown(page);
                if (!trouble.empty())
                    emit warned(QString::fromStdString(trouble));
                else if (!done.isEmpty())
                    emit said(done);
            };
        });
}

void PriorBooks::refresh()
{
    store_.giveUp(kPage);
    store_.post(kPage, [this](OwnStore& store, const Progress& wanted) -> Worker::Work {
        return [this, page = pageOf(store(), wanted)] { emit shown(page); };
    });
}

void PriorBooks::say(const std::string& finding_id, const std::string& report_uid, const std::string& prior_uid,
                     bool confirmed)
{
    change(confirmed ? tr("Confirmed: one thing then and now") : tr("Rejected: not the same thing"),
           [=, this](CaseStore& store, const PriorPage& page) {
               const PriorReport& report = reportIn(page, report_uid);
               const PriorFinding* prior = report.finding(prior_uid);
               if (!prior)
                   throw Error(ErrorCode::not_found, "this finding is no longer there", prior_uid);
               Comparison after = comparisonWith(finding_id, report, *prior, services_.scans(store, report));
               after.confirmed = confirmed;
               editComparison(store, case_id_, findComparison(store, case_id_, finding_id, report_uid, prior_uid),
                              after);
           });
}

void PriorBooks::takeBack(const std::string& finding_id, const std::string& report_uid, const std::string& prior_uid)
{
    change(tr("Taken back"), [=, this](CaseStore& store, const PriorPage&) {
        const auto before = findComparison(store, case_id_, finding_id, report_uid, prior_uid);
        if (before)
            editComparison(store, case_id_, before, std::nullopt);
    });
}

}  // namespace vicon::viewer
