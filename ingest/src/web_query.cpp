#include <algorithm>
#include <set>
#include <tuple>

#include "find.h"
#include "web_json.h"
#include "web_peer.h"

namespace vicon::ingest::web {
namespace {

constexpr const char* kJson = "application/dicom+json";
constexpr int kPage = 1000;

using Key = std::pair<const char*, std::string>;

/// As it stands in a query. Wildcards may stand there as they are, and some peers know them only so.
std::string valueOf(const WebClient& client, const std::string& text)
{
    std::string value, piece;
    for (const char c : text + '*') {
        if (c != '*' && c != '?') {
            piece += c;
            continue;
        }
        value += client.escaped(piece) + c;
        piece.clear();
    }
    value.pop_back();  // the wildcard that ended the last piece
    return value;
}

std::string queryOf(const WebClient& client, const std::vector<Key>& keys, int offset)
{
    std::string text = "?limit=" + std::to_string(kPage) + "&offset=" + std::to_string(offset);
    for (const auto& [name, value] : keys)
        if (!value.empty())
            text += std::string("&") + name + "=" + valueOf(client, value);
    return text;
}

/// QIDO-RS, page by page until nothing new comes: a peer may give fewer at a time than it is asked for, or know no
/// pages.
/// @param uid_tag what tells one match from another
template <class Take>
void search(const Peer& peer, const std::string& path, const std::vector<Key>& keys, const char* uid_tag,
            Progress& progress, const Take& take)
{
    WebClient client(peer, progress);
    std::set<std::string> seen;
    for (bool more = true; more;) {
        const auto answer = client.get(path + queryOf(client, keys, int(seen.size())), kJson);
        client.requireGood(answer, "the peer refused the query");
        more = false;
        for (const nlohmann::json& match : listFrom(client, answer)) {
            const WebItem item(match);
            const std::string uid = item.text(uid_tag);
            if (uid.empty() || !seen.insert(uid).second)
                continue;
            more = true;
            take(item);
        }
    }
}

std::string studyPath(const std::string& study_uid)
{
    return "/studies/" + uidInPath(study_uid);
}

}  // namespace

std::vector<FoundStudy> findStudies(const Peer& peer, const StudyQuery& query, Progress& progress)
{
    const std::vector<Key> keys = {{"PatientID", query.patient_id},         {"PatientName", query.patient_name},
                                   {"StudyDate", dicomDates(query.dates)},  {"AccessionNumber", query.accession_number},
                                   {"StudyInstanceUID", query.study_uid},   {"ModalitiesInStudy", query.modality},
                                   {"StudyDescription", query.description}, {"includefield", "StudyDescription"}};
    std::vector<FoundStudy> studies;
    search(peer, "/studies", keys, "0020000D", progress, [&](const WebItem& item) {
        studies.push_back({item.text("0020000D"), item.text("00100020"), item.personName("00100010"),
                           item.text("00100030"), item.text("00080020"), item.text("00080030"), item.text("00081030"),
                           item.text("00080050"), item.text("00080061"), item.count("00201206"),
                           item.count("00201208")});
    });
    std::sort(studies.begin(), studies.end(), [](const FoundStudy& a, const FoundStudy& b) {
        return std::tie(a.date, a.time, a.study_uid) < std::tie(b.date, b.time, b.study_uid);
    });
    return studies;
}

std::vector<FoundSeries> describeSeries(const Peer& peer, const std::string& study_uid, Progress& progress)
{
    std::vector<FoundSeries> series;
    search(peer, studyPath(study_uid) + "/series", {{"includefield", "BodyPartExamined"}}, "0020000E", progress,
           [&](const WebItem& item) {
               series.push_back({item.text("0020000E"), item.text("00080060"), item.text("0008103E"),
                                 item.text("00180015"), item.count("00201209")});
           });
    std::sort(series.begin(), series.end(), [](const auto& a, const auto& b) { return a.uid < b.uid; });
    return series;
}

std::vector<std::string> findObjects(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                     Progress& progress)
{
    std::vector<std::string> objects;
    search(peer, studyPath(study_uid) + "/series/" + uidInPath(series_uid) + "/instances", {}, "00080018", progress,
           [&](const WebItem& item) { objects.push_back(item.text("00080018")); });
    std::sort(objects.begin(), objects.end());
    return objects;
}

void echo(const Peer& peer)
{
    NoProgress quiet;
    WebClient client(peer, quiet);
    const auto answer = client.get("/studies?limit=1", kJson);
    client.requireGood(answer, "the peer answers no query");
    listFrom(client, answer);
}

}  // namespace vicon::ingest::web
