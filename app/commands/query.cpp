#include "vicon/ingest/query.h"

#include <cstdio>

#include "../command.h"
#include "../operation_audit.h"
#include "../peers.h"
#include "../text_table.h"
#include "vicon/ingest/modality_worklist.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {
namespace {

nlohmann::json studiesJson(const std::vector<ingest::FoundStudy>& studies)
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

nlohmann::json stepsJson(const std::vector<ingest::ScheduledStep>& steps)
{
    nlohmann::json list = nlohmann::json::array();
    for (const ingest::ScheduledStep& s : steps)
        list.push_back({{"patient", s.patient},
                        {"study_uid", s.study_uid},
                        {"accession_number", s.accession_number},
                        {"referring_physician", s.referring_physician},
                        {"procedure_id", s.procedure_id},
                        {"procedure", s.procedure},
                        {"reason", s.reason},
                        {"modality", s.modality},
                        {"station", s.station},
                        {"date", s.date},
                        {"time", s.time},
                        {"description", s.description}});
    return {{"steps", list}};
}

int queryWorklist(Context& context, const std::string& peer_name, const ingest::StudyQuery& query)
{
    NoProgress quiet;
    const ingest::Peer peer = requirePeer(context.config(), peer_name, PeerUse::query);
    auditOperation(context.storePlace(), AuditEvent::peer_asked, peer_name + " for scheduled studies");
    const auto steps =
        ingest::findScheduledSteps(peer, query, context.config().get<ingest::ReceiverOptions>().ae_title, quiet);
    if (context.json) {
        std::printf("%s\n", stepsJson(steps).dump(2).c_str());
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const ingest::ScheduledStep& s : steps)
        rows.push_back({s.date, s.time, s.patient.id, s.patient.name, s.accession_number, s.procedure,
                        s.referring_physician, s.modality, s.station});
    std::printf("%s", formatTable({"date", "time", "patient", "name", "accession", "procedure", "referring", "modality",
                                   "station"},
                                  rows)
                          .c_str());
    return 0;
}

int query(Context& context, const std::string& peer_name, const ingest::StudyQuery& query)
{
    NoProgress quiet;
    const ingest::Peer peer = requirePeer(context.config(), peer_name, PeerUse::query);
    auditOperation(context.storePlace(), AuditEvent::peer_asked, peer_name + " for studies");
    const auto studies =
        ingest::findStudies(peer, query, context.config().get<ingest::ReceiverOptions>().ae_title, quiet);
    if (context.json) {
        std::printf("%s\n", studiesJson(studies).dump(2).c_str());
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const ingest::FoundStudy& s : studies)
        rows.push_back({s.date, s.patient_id, s.patient_name, s.description, s.modalities, countText(s.series),
                        countText(s.images), s.study_uid});
    if (rows.empty()) {
        const std::string hint =
            query.modality.empty() ? "" : " of modality " + query.modality + "; --modality '': any";
        std::printf("no study fits%s\n", hint.c_str());
        return 0;
    }
    std::printf("%s",
                formatTable({"date", "patient", "name", "description", "modalities", "series", "images", "study"}, rows)
                    .c_str());
    return 0;
}

}  // namespace

Subcommand queryCommand()
{
    return {"query", "Look for studies in a PACS, or for scheduled ones in a modality worklist (C-FIND)",
            [](CommandLine& command) {
                auto peer = std::make_shared<std::string>();
                auto wanted = std::make_shared<ingest::StudyQuery>();
                auto scheduled = std::make_shared<bool>(false);
                command.option("PEER", *peer, "Name of a peer in the configuration").required();
                command.option("--patient", wanted->patient_id, "Patient ID; * and ? match anything");
                command.option("--name", wanted->patient_name, "Patient's name, as 'FAMILY*'");
                command.option("--date", wanted->dates,
                               "2024-01-10 or 20240110; or two of them with - between, an end left out or not");
                command.option("--accession", wanted->accession_number, "Accession number");
                command.option("--study", wanted->study_uid, "Study Instance UID");
                command.option("--modality", wanted->modality, "That some series has; empty: any")
                    .captureDefault()
                    .mayBeEmpty();
                auto description = command.option("--description", wanted->description,
                                                  "Description of the study; * and ? match anything");
                auto series = command.option("--series-description", wanted->series_description,
                                             "Of one of its series, as above; asked of each study that fits the rest");
                command
                    .flag("--worklist", *scheduled,
                          "What is scheduled, by the peer's modality worklist; --date is that of the step")
                    .excludes(description)
                    .excludes(series);
                return [peer, wanted, scheduled](Context& context) {
                    return *scheduled ? queryWorklist(context, *peer, *wanted) : query(context, *peer, *wanted);
                };
            }};
}

}  // namespace vicon::app
