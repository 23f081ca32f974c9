#include "vicon/ingest/query.h"

#include <cstdio>

#include "../command.h"
#include "../peers.h"
#include "../text_table.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {
namespace {

nlohmann::json toJson(const std::vector<ingest::FoundStudy>& studies)
{
    nlohmann::json list = nlohmann::json::array();
    for (const ingest::FoundStudy& s : studies)
        list.push_back({{"study_uid", s.study_uid},
                        {"patient", {{"id", s.patient_id}, {"name", s.patient_name}, {"birth_date", s.birth_date}}},
                        {"date", s.date},
                        {"time", s.time},
                        {"description", s.description},
                        {"accession_number", s.accession_number},
                        {"modalities", s.modalities},
                        {"series", s.series},
                        {"images", s.images}});
    return {{"studies", list}};
}

std::string countText(int count)
{
    return count < 0 ? "" : std::to_string(count);
}

int query(Context& context, const std::string& peer_name, const ingest::StudyQuery& query)
{
    NoProgress quiet;
    const auto studies = ingest::findStudies(requirePeer(context.config(), peer_name), query,
                                             context.config().get<ingest::ReceiverOptions>().ae_title, quiet);
    if (context.json) {
        std::printf("%s\n", toJson(studies).dump(2).c_str());
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const ingest::FoundStudy& s : studies)
        rows.push_back({s.date, s.patient_id, s.patient_name, s.description, s.modalities, countText(s.series),
                        countText(s.images), s.study_uid});
    std::printf("%s",
                formatTable({"date", "patient", "name", "description", "modalities", "series", "images", "study"}, rows)
                    .c_str());
    return 0;
}

}  // namespace

Subcommand queryCommand()
{
    return {"query", "Look for studies in a PACS (C-FIND)", [](CommandLine& command) {
                auto peer = std::make_shared<std::string>();
                auto wanted = std::make_shared<ingest::StudyQuery>();
                command.option("PEER", *peer, "Name of a peer in the configuration").required();
                command.option("--patient", wanted->patient_id, "Patient ID; * and ? match anything");
                command.option("--name", wanted->patient_name, "Patient's name, as 'FAMILY*'");
                command.option("--date", wanted->dates,
                               "2024-01-10 or 20240110; or two of them with - between, an end left out or not");
                command.option("--accession", wanted->accession_number, "Accession number");
                command.option("--study", wanted->study_uid, "Study Instance UID");
                command.option("--modality", wanted->modality, "That some series has; empty: any").captureDefault();
                return [peer, wanted](Context& context) { return query(context, *peer, *wanted); };
            }};
}

}  // namespace vicon::app
