#include <soci/soci.h>

#include <algorithm>

#include "case_rows.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

/// Before the id of a case whose markers.json is older than its rows. Set with the rows, in their transaction, and
/// taken away when the file is written, so that neither a full disk nor a kill between the two leaves it old for good.
const std::string kFileIsOld = "markers.json ";

/// What follows from where a marker lies and from the scan's skeleton. Whoever makes the skeleton anew renews it.
constexpr const char* kFromSkeleton[] = {"station_mm", "from_caecum_mm", "fraction", "part"};

/// Neither when a marker was last written nor a new skeleton makes it another one.
bool same(const std::optional<Marker>& a, const std::optional<Marker>& b)
{
    if (!a || !b)
        return !a && !b;
    json x = toJson(*a), y = toJson(*b);
    for (json* marker : {&x, &y}) {
        marker->erase("changed");
        for (const char* key : kFromSkeleton)
            marker->erase(key);
    }
    return x == y;
}

/// What the writer saw of the old skeleton and did not change stays as it is stored.
void keepRenewedPlace(const Marker& stored, MarkerEdit& edit)
{
    const json seen = toJson(*edit.before), now = toJson(stored);
    json wanted = toJson(*edit.after);
    const auto at = [](const json& marker, const char* key) { return marker.value(key, json()); };
    if (edit.after->position_mm == stored.position_mm && edit.after->scan_id == stored.scan_id)
        for (const char* key : kFromSkeleton) {
            if (at(wanted, key) != at(seen, key))
                continue;
            wanted.erase(key);
            if (now.contains(key))
                wanted[key] = now[key];
        }
    edit.after = markerFromJson(wanted);
}

/// The markers of one case, within a transaction.
class MarkerRows {
public:
    MarkerRows(soci::session& sql, const std::string& case_id) : sql_(sql), case_id_(case_id) {}

    std::vector<Marker> all() const
    {
        std::vector<Marker> out;
        const soci::rowset<std::string> rows =
            (sql_.prepare << "SELECT content FROM markers WHERE case_id = :c ORDER BY rowid", soci::use(case_id_));
        for (const std::string& content : rows)
            out.push_back(markerFromJson(json::parse(content)));
        return out;
    }

    std::optional<Marker> find(const std::string& id) const
    {
        const auto markers = all();
        const auto found = std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.id == id; });
        return found == markers.end() ? std::nullopt : std::optional(*found);
    }

    /// Gives it its id and its times.
    void put(Marker& marker)
    {
        marker.changed = nowUtc();
        if (marker.created.empty())
            marker.created = marker.changed;
        if (marker.id.empty())
            marker.id = "m" + std::to_string(takeNumber(sql_, "marker " + case_id_));
        const auto before = find(marker.id);
        const std::string content = toJson(marker).dump();
        sql_ << "INSERT INTO markers (case_id, id, scan_id, content) VALUES (:case, :id, :scan, :content)"
                " ON CONFLICT (case_id, id) DO UPDATE SET scan_id = excluded.scan_id, content = excluded.content",
            soci::use(case_id_), soci::use(marker.id), soci::use(marker.scan_id), soci::use(content);
        putAudit(sql_, {AuditEvent::marker_saved, case_id_, marker.scan_id, marker.id,
                        before ? toJson(*before).dump() : "", content});
    }

    void remove(const Marker& marker)
    {
        sql_ << "DELETE FROM markers WHERE case_id = :c AND id = :id", soci::use(case_id_), soci::use(marker.id);
        putAudit(sql_, {AuditEvent::marker_removed, case_id_, marker.scan_id, marker.id, toJson(marker).dump(), ""});
    }

    void apply(MarkerEdit& edit)
    {
        if (edit.after)
            put(*edit.after);
        else if (edit.before)
            remove(*edit.before);
    }

    /// Takes this marker from those that name it although it no longer names them; these edits follow at the end.
    void partFormer(const MarkerEdit& edit, std::vector<MarkerEdit>& done)
    {
        if (!edit.before)
            return;
        const auto now = find(edit.before->id);  // a later edit may have changed it once more
        const std::vector<std::string> partners = now ? now->partners : std::vector<std::string>();
        if (partners == edit.before->partners && now)
            return;
        const auto names = [](const std::vector<std::string>& ids, const std::string& id) {
            return std::find(ids.begin(), ids.end(), id) != ids.end();
        };
        for (const Marker& other : all()) {
            if (!names(other.partners, edit.before->id) || names(partners, other.id))
                continue;
            MarkerEdit parting{other, other};
            std::erase(parting.after->partners, edit.before->id);
            put(*parting.after);
            done.push_back(parting);
        }
    }

    void fileIsOld()
    {
        const std::string name = kFileIsOld + case_id_;
        sql_ << "INSERT INTO counters (name, value) VALUES (:name, 1) ON CONFLICT (name) DO NOTHING", soci::use(name);
    }

private:
    soci::session& sql_;
    const std::string& case_id_;
};

void requireAsSeen(const MarkerRows& rows, const MarkerEdit& edit)
{
    if (edit.before && edit.after && edit.before->id != edit.after->id)
        throw Error(ErrorCode::internal, "an edit joins two markers", edit.before->id);
    const std::string id = edit.before ? edit.before->id : edit.after ? edit.after->id : "";
    if (!id.empty() && !same(rows.find(id), edit.before))
        throw Error(ErrorCode::bad_input, "another reader changed this marker meanwhile; nothing was written", id,
                    "look at the list, which shows it as it is now, and do it again if you still want it");
}

}  // namespace

std::vector<Marker> CaseStore::markers(const std::string& case_id)
{
    return database_.read([&](soci::session& sql) { return MarkerRows(sql, case_id).all(); });
}

Marker CaseStore::requireMarker(const std::string& case_id, const std::string& marker_id)
{
    if (auto found = database_.read([&](soci::session& sql) { return MarkerRows(sql, case_id).find(marker_id); }))
        return *found;
    throw Error(ErrorCode::not_found, "no marker '" + marker_id + "'", case_id,
                "'vicon markers " + case_id + "' lists them");
}

Marker CaseStore::saveMarker(const std::string& case_id, Marker marker)
{
    requireRole(Role::mark);
    database_.write([&](soci::session& sql) {
        MarkerRows rows(sql, case_id);
        const MarkerEdit edit{rows.find(marker.id), marker};
        std::vector<MarkerEdit> parted;
        rows.put(marker);
        rows.partFormer(edit, parted);
        rows.fileIsOld();
    });
    renewMarkerFiles(case_id);
    return marker;
}

void CaseStore::removeMarker(const std::string& case_id, const std::string& marker_id)
{
    requireRole(Role::mark);
    database_.write([&](soci::session& sql) {
        MarkerRows rows(sql, case_id);
        const MarkerEdit edit{requireMarker(case_id, marker_id), std::nullopt};
        std::vector<MarkerEdit> parted;
        rows.remove(*edit.before);
        rows.partFormer(edit, parted);
        rows.fileIsOld();
    });
    renewMarkerFiles(case_id);
}

std::vector<MarkerEdit> CaseStore::editMarkers(const std::string& case_id, std::vector<MarkerEdit> edits)
{
    requireRole(Role::mark);
    database_.write([&](soci::session& sql) {
        if (!findCase(case_id))
            throw Error(ErrorCode::not_found, "no such case", "'" + case_id + "'", "'vicon cases' lists them");
        MarkerRows rows(sql, case_id);
        for (MarkerEdit& edit : edits) {
            requireAsSeen(rows, edit);
            if (edit.before && edit.after)
                keepRenewedPlace(*rows.find(edit.before->id), edit);
            rows.apply(edit);
        }
        for (std::size_t n = 0, asked = edits.size(); n < asked; ++n)
            rows.partFormer(MarkerEdit(edits[n]), edits);
        rows.fileIsOld();
    });
    renewMarkerFiles(case_id);
    return edits;
}

void CaseStore::renewMarkerFiles()
{
    const std::string pattern = kFileIsOld + "%";
    const auto old = database_.read([&](soci::session& sql) {  // to its end before the first of them is written
        std::vector<std::string> cases;
        const soci::rowset<std::string> rows =
            (sql.prepare << "SELECT name FROM counters WHERE name LIKE :pattern", soci::use(pattern));
        for (const std::string& name : rows)
            cases.push_back(name.substr(kFileIsOld.size()));
        return cases;
    });
    for (const std::string& case_id : old)
        renewMarkerFiles(case_id);
}

void CaseStore::renewMarkerFiles(const std::string& case_id)
{
    marker_file_trouble_.clear();
    try {
        // The files are written while the database is locked: of two readers the later one writes the later list.
        database_.write([&](soci::session& sql) {
            const std::string name = kFileIsOld + case_id;
            int old = 0;
            sql << "SELECT COUNT(*) FROM counters WHERE name = :name", soci::use(name), soci::into(old);
            if (old == 0)
                return;
            if (findCase(case_id))
                writeMarkerFiles(case_id);
            sql << "DELETE FROM counters WHERE name = :name", soci::use(name);
        });
    } catch (const std::exception& e) {
        marker_file_trouble_ = e.what();  // the markers are saved; that their copy is old is on record
    }
}

void CaseStore::writeMarkerFiles(const std::string& case_id)
{
    const std::vector<Marker> all = markers(case_id);
    const auto write = [&](const fs::path& folder, const std::string& scan_id) {
        std::vector<Marker> some;
        for (const Marker& marker : all)
            if (scan_id.empty() || marker.scan_id == scan_id)
                some.push_back(marker);
        writeMarkers(folder / "markers.json", some);
    };
    write(caseFolder(case_id), "");
    for (const ScanRecord& scan : scans(case_id))
        if (fs::is_directory(scanFolder(case_id, scan.id)))
            write(scanFolder(case_id, scan.id), scan.id);
}

}  // namespace vicon
