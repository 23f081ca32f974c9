#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <optional>

#include "session/own_store.h"
#include "vicon/cases/report_content.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// What the form shows, as the database has it.
struct ReportPage {
    ReadCase read;
    KnownStudy known;  ///< without its reader
    ReportStatus status;
    std::vector<std::string> missing;  ///< for a signature
    std::string delivery;              ///< "2 committed"; empty: nothing was to be sent
};

/// Findings, what is said of the study, and the report's state, on a thread of their own. A change is applied to what
/// this reader saw last, and refused where another reader was faster; the page follows in either case.
class ReportBooks : public QObject {
    Q_OBJECT
public:
    ReportBooks(const ReadingServices& services, std::string case_id, QObject* parent);

    void refresh();
    void say(std::function<void(Assessment&)> change);
    void changeFinding(const std::string& id, std::function<void(Finding&)> change);
    /// One of each of these markers, with those that it is paired with: all in one step, or none.
    void addFindings(const std::vector<std::string>& markers);
    /// These markers and their partners show this finding as well.
    void join(const std::string& id, const std::vector<std::string>& markers);
    /// Its markers stay.
    void removeFinding(const std::string& id);
    void sign();
    /// Until it is signed; what signs says so once it has ended.
    void giveUpSigning();
    void amend(const QString& reason);
    void cancelAmendment();
    /// deliveryLookedAt() follows.
    void lookAtDelivery();
    /// textMade() follows.
    void makeText();
    /// pdfMade() follows, or warned().
    void makePdf();
    void giveUpPdf();
    /// What takes so long that it can be given up.
    enum class Making { nothing, pages, signature };
    Making making() const { return making_; }
    bool busy() const { return under_way_ > 0; }

signals:
    void shown(const vicon::viewer::ReportPage& page);
    void said(const QString& what);
    void warned(const QString& what);
    /// @param brief as in ReportPage
    void deliveryLookedAt(const QString& brief);
    void textMade(const QString& text);
    void pdfMade(const QByteArray& pdf);
    void busyChanged(bool busy);
    void makingChanged(vicon::viewer::ReportBooks::Making what);

private:
    struct Books {
        explicit Books(StorePlace place) : store(std::move(place)) {}
        OwnStore store;
        std::optional<ReadCase> seen;     ///< what was shown last
        std::optional<KnownStudy> known;  ///< it stays: the images do not change
    };
    using Change = std::function<void(CaseStore&, const ReadCase& seen)>;
    /// @param done is said when it is done; may be empty
    void change(const QString& done, Change change, Making what = Making::nothing);
    void begin();
    void end();
    void setMaking(Making what);
    ReportPage pageOf(Books& books) const;

    const ReportServices services_;
    const std::string case_id_;
    int under_way_ = 0;
    Making making_ = Making::nothing;
    std::shared_ptr<Wanted> signature_wanted_;  ///< while it is made
    WorkerWith<Books> books_;                   // last: it ends first
};

}  // namespace vicon::viewer
