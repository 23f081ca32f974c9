// What is kept beside a case's markers: pictures, films, drafts of reports, the audit trail.
#include <algorithm>

#include "session/case_session.h"
#include "vicon/core/file.h"

namespace vicon::viewer {

std::filesystem::path CaseSession::newPicture(CaseStore& store, const std::string& extension) const
{
    const std::string& id = row_.record.id;
    store.requireCase(id);
    const auto folder = store.caseFolder(id) / "pictures";
    makePrivateFolder(folder);
    return folder / (std::to_string(store.nextNumber("picture " + id)) + extension);
}

void CaseSession::nameFilm()
{
    books_.postAlways([this](Books& books) -> Worker::Work {
        QString name, trouble;
        try {
            name = QString::fromStdString(newPicture(books.store(), ".ogv").string());
        } catch (const std::exception& e) {
            trouble = e.what();
        }
        return [this, name, trouble] {
            if (!trouble.isEmpty())
                emit warned(trouble);
            emit filmNamed(name);
        };
    });
}

void CaseSession::savePicture(const QImage& picture)
{
    books_.postAlways([this, picture = picture.convertToFormat(QImage::Format_RGB888)](Books& books) -> Worker::Work {
        const auto file = newPicture(books.store(), ".png");
        Picture out(picture.width(), picture.height());
        for (int y = 0; y < out.height; ++y)
            std::copy_n(picture.constScanLine(y), 3 * out.width, out.rgb.begin() + std::ptrdiff_t(y) * 3 * out.width);
        writePng(file, out);
        books.store().audit(AuditEvent::picture_saved, row_.record.id, "", file.filename().string());
        return [this, name = QString::fromStdString(file.string())] { emit saved(tr("Picture saved: %1").arg(name)); };
    });
}

void CaseSession::log(AuditEvent event, const std::string& scan_id, const QString& words)
{
    books_.postAlways([this, event, scan_id, words](Books& books) -> Worker::Work {
        books.store().audit(event, row_.record.id, scan_id, words.toStdString());
        return {};
    });
}

void CaseSession::writeReport()
{
    report_wanted_ = std::make_shared<Wanted>();
    books_.postAlways([this, wanted = report_wanted_](Books& books) -> Worker::Work {
        QString file, trouble;
        try {
            file = QString::fromStdString(services_.report(books.store(), row_.record.id, *wanted).string());
        } catch (const std::exception& e) {
            trouble = e.what();
        }
        return [this, wanted, file, trouble] {
            report_wanted_.reset();
            if (!file.isEmpty())
                emit reportWritten(file);
            else if (wanted->cancelled())
                emit saved(tr("The report was given up; nothing was written."));
            else
                emit warned(trouble);
        };
    });
}

bool CaseSession::giveUpReport()
{
    if (report_wanted_)
        report_wanted_->giveUp();
    return report_wanted_ != nullptr;
}

}  // namespace vicon::viewer
