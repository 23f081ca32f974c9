#include "report/report_books.h"

#include <algorithm>
#include <set>

#include "vicon/cases/outbox.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr const char* kPages = "pages";

Finding findingSeen(const ReadCase& seen, const std::string& id)
{
    for (const FindingWithFacts& one : seen.findings)
        if (one.finding.id == id)
            return one.finding;
    throw Error(ErrorCode::not_found, "this finding was removed", id);
}

}  // namespace

ReportBooks::ReportBooks(const ReadingServices& services, std::string case_id, QObject* parent)
    : QObject(parent), services_(services.reporting), case_id_(std::move(case_id)), books_(this, services.store)
{
    connect(books_.worker(), &Worker::failed, this, &ReportBooks::warned);
}

ReportPage ReportBooks::pageOf(Books& books) const
{
    CaseStore& store = books.store();
    if (!books.known && services_.known)
        books.known = services_.known(store, case_id_);
    ReportPage page{
        readCase(store, case_id_), books.known.value_or(KnownStudy{}), reportStatus(store, case_id_), {}, {}};
    page.delivery = deliveryInBrief(countDeliveries(store, case_id_));
    page.missing = missingForSignature(page.read);
    return page;
}

void ReportBooks::change(const QString& done, Change change, Making what)
{
    begin();
    books_.postAlways([this, done, change = std::move(change), what](Books& books) -> Worker::Work {
        std::string trouble;
        bool given_up = false;
        std::optional<ReportPage> page;
        try {
            if (!books.seen)
                books.seen = readCase(books.store(), case_id_);
            change(books.store(), *books.seen);
        } catch (const Error& e) {
            given_up = what != Making::nothing && e.code() == ErrorCode::cancelled;
            trouble = given_up ? "" : e.what();
        } catch (const std::exception& e) {
            trouble = e.what();
        }
        try {  // shown as it is now, whatever happened
            page = pageOf(books);
            books.seen = page->read;
        } catch (const std::exception& e) {
            trouble = trouble.empty() ? e.what() : trouble;
        }
        return [this, done, trouble, page, what, given_up] {
            if (page && under_way_ == 1)  // else what the reader has said meanwhile would be taken from the form
                emit shown(*page);
            if (what != Making::nothing)
                setMaking(Making::nothing);
            end();
            if (!trouble.empty())
                emit warned(QString::fromStdString(trouble));
            else if (given_up)
                emit said(tr("Signing was given up; nothing was signed."));
            else if (!done.isEmpty())
                emit said(done);
        };
    });
}

void ReportBooks::begin()
{
    if (++under_way_ == 1)
        emit busyChanged(true);
}

void ReportBooks::end()
{
    if (--under_way_ == 0)
        emit busyChanged(false);
}

void ReportBooks::setMaking(Making what)
{
    making_ = what;
    emit makingChanged(what);
}

void ReportBooks::refresh()
{
    change({}, [](CaseStore&, const ReadCase&) {});
}

void ReportBooks::say(std::function<void(Assessment&)> what)
{
    change(tr("Saved"), [id = case_id_, what = std::move(what)](CaseStore& store, const ReadCase& seen) {
        Assessment after = seen.assessment;
        what(after);
        if (toJson(after) != toJson(seen.assessment))
            saveAssessment(store, id, seen.assessment, after);
    });
}

void ReportBooks::changeFinding(const std::string& id, std::function<void(Finding&)> what)
{
    change(tr("Saved"), [this, id, what = std::move(what)](CaseStore& store, const ReadCase& seen) {
        const Finding before = findingSeen(seen, id);
        Finding after = before;
        what(after);
        if (toJson(after) != toJson(before))
            editFindings(store, case_id_, {{before, after}});
    });
}

void ReportBooks::addFindings(const std::vector<std::string>& markers)
{
    change(tr("Findings added"), [this, markers](CaseStore& store, const ReadCase&) {
        std::vector<FindingEdit> edits;
        std::set<std::string> taken;
        for (const std::string& marker : markers) {
            if (taken.count(marker))
                continue;
            Finding finding;
            finding.markers = withPartners(store, case_id_, {marker});
            taken.insert(finding.markers.begin(), finding.markers.end());
            edits.push_back({std::nullopt, finding});
        }
        editFindings(store, case_id_, edits);
    });
}

void ReportBooks::join(const std::string& id, const std::vector<std::string>& markers)
{
    change(tr("Markers joined to the finding"), [this, id, markers](CaseStore& store, const ReadCase& seen) {
        const Finding before = findingSeen(seen, id);
        Finding after = before;
        for (const std::string& marker : withPartners(store, case_id_, markers))
            if (std::find(after.markers.begin(), after.markers.end(), marker) == after.markers.end())
                after.markers.push_back(marker);
        editFindings(store, case_id_, {{before, after}});
    });
}

void ReportBooks::removeFinding(const std::string& id)
{
    change(tr("Finding removed; its markers stay"), [this, id](CaseStore& store, const ReadCase& seen) {
        editFindings(store, case_id_, {{findingSeen(seen, id), std::nullopt}});
    });
}

// A signature is no work that the window's closing gives up: the reader was asked, and said so.
void ReportBooks::sign()
{
    signature_wanted_ = std::make_shared<Wanted>();
    setMaking(Making::signature);
    const auto signIt = [this, wanted = signature_wanted_](CaseStore& store, const ReadCase& seen) {
        // What is signed is what was on the screen.
        if (reportContent(readCase(store, case_id_)) != reportContent(seen))
            throw Error(ErrorCode::bad_input, "the case was changed meanwhile; nothing was signed", case_id_,
                        "read the form again, then sign");
        services_.sign(store, case_id_, *wanted);
    };
    change(tr("The report is signed"), signIt, Making::signature);
}

void ReportBooks::giveUpSigning()
{
    if (signature_wanted_)
        signature_wanted_->giveUp();
}

void ReportBooks::amend(const QString& reason)
{
    change(tr("The report is open for an amendment"),
           [this, reason = reason.toStdString()](CaseStore& store, const ReadCase&) {
               services_.amend(store, case_id_, reason);
           });
}

void ReportBooks::cancelAmendment()
{
    change(tr("The amendment is taken back"),
           [this](CaseStore& store, const ReadCase&) { services_.cancel_amendment(store, case_id_); });
}

void ReportBooks::lookAtDelivery()
{
    books_.post("delivery", [this](Books& books) -> Worker::Work {
        const std::string brief = deliveryInBrief(countDeliveries(books.store(), case_id_));
        return [this, brief = QString::fromStdString(brief)] { emit deliveryLookedAt(brief); };
    });
}

void ReportBooks::makeText()
{
    books_.post("text", [this](Books& books) -> Worker::Work {
        return [this, text = QString::fromStdString(services_.text(books.store(), case_id_))] { emit textMade(text); };
    });
}

void ReportBooks::makePdf()
{
    setMaking(Making::pages);
    begin();
    books_.post(kPages, [this](Books& books, Progress& wanted) -> Worker::Work {
        std::string pdf, trouble;
        try {
            pdf = services_.pdf(books.store(), case_id_, wanted);
        } catch (const std::exception& e) {
            wanted.check();
            trouble = e.what();
        }
        return [this, trouble, bytes = QByteArray(pdf.data(), int(pdf.size()))] {
            setMaking(Making::nothing);
            end();
            if (trouble.empty())
                emit pdfMade(bytes);
            else
                emit warned(QString::fromStdString(trouble));
        };
    });
}

void ReportBooks::giveUpPdf()
{
    if (!books_.giveUp(kPages))
        return;
    setMaking(Making::nothing);
    end();
    emit said(tr("The pages are not drawn."));
}

}  // namespace vicon::viewer
