#include "session/case_session.h"

#include <algorithm>
#include <utility>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

/// What a reader makes of markers; where they lie along the path follows from the scan.
nlohmann::json withoutPlaces(const std::vector<Marker>& markers)
{
    nlohmann::json list = toJson(markers)["markers"];
    for (nlohmann::json& marker : list)
        for (const char* key : {"station_mm", "from_caecum_mm", "fraction", "part", "changed"})
            marker.erase(key);
    return list;
}

QString caseIsGone()
{
    return CaseSession::tr(
        "This case was deleted while you read it. The pictures stay until you close the window, but markers, pictures "
        "and "
        "reports can no longer be saved.");
}

}  // namespace

CaseSession::CaseSession(const ReadingServices& services, const WorklistCase& row, QObject* parent)
    : QObject(parent), services_(services), row_(row), books_(this, services.store, row.record.id)
{
    renew(row);
    connect(books_.worker(), &Worker::failed, this, &CaseSession::warned);
    connect(&loader_, &Worker::failed, this, &CaseSession::warned);
    books_.postAlways([this](Books& books) -> Worker::Work {
        books.in_use.emplace(services_.store.folder, row_.record.id);
        books.store().audit(AuditEvent::case_opened, row_.record.id, {}, {});
        return [] {};
    });
    refresh();
}

std::vector<ScanRecord> CaseSession::renew(const WorklistCase& row)
{
    row_.scans = row.scans;  // the case's record stays: the workers read it
    std::vector<ScanRecord> added;
    for (const WorklistScan& scan : row.scans)
        if (scan.ready() && std::none_of(scans_.begin(), scans_.end(),
                                         [&](const ScanRecord& known) { return known.id == scan.record.id; }))
            added.push_back(scan.record);
    scans_.insert(scans_.end(), added.begin(), added.end());
    return added;
}

std::string CaseSession::messageFor(CaseStore& store, const Error& error) const
{
    if (error.code() == ErrorCode::not_found && !store.findCase(row_.record.id))
        return caseIsGone().toStdString();
    return error.what();
}

std::vector<Marker> CaseSession::markersOf(const std::string& scan_id) const
{
    std::vector<Marker> some;
    std::copy_if(markers_.begin(), markers_.end(), std::back_inserter(some),
                 [&](const Marker& marker) { return marker.scan_id == scan_id; });
    return some;
}

std::optional<Marker> CaseSession::marker(const std::string& id) const
{
    const auto found = std::find_if(markers_.begin(), markers_.end(), [&](const Marker& m) { return m.id == id; });
    return found == markers_.end() ? std::nullopt : std::optional(*found);
}

void CaseSession::edit(const QString& what, Edit work)
{
    const bool first = ++edits_under_way_ == 1;
    books_.postAlways([this, what, work = std::move(work)](Books& books) -> Worker::Work {
        std::string trouble, copy_trouble;
        bool given_up = false;
        std::optional<std::vector<Marker>> markers;
        try {
            work(books);
            copy_trouble = books.store().markerFileTrouble();
        } catch (const Error& e) {
            given_up = e.code() == ErrorCode::cancelled;
            trouble = given_up ? "" : messageFor(books.store(), e);
        } catch (const std::exception& e) {
            trouble = e.what();
        }
        try {  // the list is shown as it is now, whatever happened
            markers = books.store().markers(row_.record.id);
        } catch (const std::exception& e) {
            trouble = trouble.empty() ? e.what() : trouble;
        }
        return [this, said = given_up ? tr("Given up; nothing was changed.") : what, trouble, copy_trouble,
                markers = std::move(markers), undo = books.history.toUndo(), redo = books.history.toRedo()] {
            if (markers)
                markers_ = *markers;
            else
                markers_known_ = false;  // what is read next is not another reader's doing
            to_undo_ = undo;
            to_redo_ = redo;
            edited();
            if (trouble.empty())
                emit saved(said);
            else
                emit warned(QString::fromStdString(trouble));
            if (!copy_trouble.empty())
                emit warned(tr("The marker is saved in the database; its copy in markers.json will be written "
                               "later: %1")
                                .arg(QString::fromStdString(copy_trouble)));
        };
    });
    if (first)  // last: who hears it may have something to save, which comes after this
        emit busyChanged(true);
}

void CaseSession::edited()
{
    --edits_under_way_;  // first: what is shown of the markers waits for edits that are still to come, not for this one
    emit markersChanged();
    if (edits_under_way_ == 0)
        emit busyChanged(false);
}

void CaseSession::addMarker(const Marker& marker)
{
    edit(tr("Marker saved"), [this, marker](Books& books) {
        books.history.add(books.store(), services_.place(books.store(), row_.record.id, marker));
    });
}

void CaseSession::changeMarker(const Marker& before, const Marker& after, bool moved, const QString& what)
{
    edit(what.isEmpty() ? tr("Change saved") : what, [this, before, after, moved](Books& books) {
        CaseStore& store = books.store();
        books.history.change(store, before, moved ? services_.place(store, row_.record.id, after) : after);
    });
}

void CaseSession::removeMarker(const Marker& marker)
{
    edit(tr("Marker deleted"), [marker](Books& books) { books.history.remove(books.store(), marker); });
}

void CaseSession::pairMarkers(const Marker& a, const Marker& b)
{
    edit(tr("Paired"), [a, b](Books& books) { books.history.pair(books.store(), a, b); });
}

void CaseSession::partMarkers(const Marker& marker)
{
    edit(tr("Parted"), [marker](Books& books) { books.history.part(books.store(), marker); });
}

void CaseSession::loadMarkers(const std::filesystem::path& file)
{
    loading_wanted_ = std::make_shared<Wanted>();
    edit(tr("Markers loaded"), [this, file, wanted = loading_wanted_](Books& books) {
        books.history.changeAll(books.store(), services_.import_markers(books.store(), row_.record.id, file, *wanted));
    });
}

void CaseSession::giveUpLoadingMarkers()
{
    if (loading_wanted_)
        loading_wanted_->giveUp();
}

void CaseSession::saveMarkers(const std::filesystem::path& file)
{
    books_.postAlways([this, file](Books& books) -> Worker::Work {
        writeMarkers(file, books.store().markers(row_.record.id));
        return
            [this, name = QString::fromStdString(file.string())] { emit saved(tr("Markers written: %1").arg(name)); };
    });
}

void CaseSession::takeBack(const QString& what, void (MarkerHistory::*step)(CaseStore&))
{
    edit(what, [this, step](Books& books) {
        (books.history.*step)(books.store());
        if (books.skeleton_is_new)
            services_.renew_places(books.store(), row_.record.id);
    });
}

void CaseSession::undo()
{
    takeBack(tr("Undone"), &MarkerHistory::undo);
}

void CaseSession::redo()
{
    takeBack(tr("Done again"), &MarkerHistory::redo);
}

void CaseSession::placeAnew(const QString& what)
{
    edit(what, [this](Books& books) {
        books.skeleton_is_new = true;
        QStringList lost;
        for (const std::string& id : services_.renew_places(books.store(), row_.record.id))
            lost << QString::fromStdString(id);
        if (!lost.empty())
            throw Error(ErrorCode::wrong_use, "no longer in the colon; distances and segment stay as they were",
                        lost.join(", ").toStdString(), "move or delete them");
    });
}

void CaseSession::refresh()
{
    books_.post("refresh", [this](Books& books) -> Worker::Work {
        const auto record = books.store().findCase(row_.record.id);
        if (!record)
            return [this] { emit warned(caseIsGone()); };
        return [this, flags = record->flags, markers = books.store().markers(row_.record.id)] {
            if (std::exchange(row_.record.flags, flags) != flags)
                emit flagsChanged();
            if (markers_known_ && toJson(markers) == toJson(markers_))
                return;
            const bool by_other = markers_known_ && withoutPlaces(markers) != withoutPlaces(markers_);
            markers_known_ = true;
            markers_ = markers;
            emit markersChanged();
            if (by_other)
                emit warned(
                    tr("Another reader changed the markers of this case; the list shows them as they are now."));
        };
    });
}

}  // namespace vicon::viewer
