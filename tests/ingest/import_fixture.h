#pragma once

#include <soci/soci.h>
#include <fstream>
#include <map>
#include <string>

#include "dicom_writer.h"
#include "store_fixture.h"

namespace vicon::test {

/// Imports into a store of its own, and what a store holds after them.
class Import : public StoreFixture {
protected:
    /// Everything in the store that an import decides, without times: rows, and every file with its content's hash.
    static std::map<std::string, std::string> stateOf(CaseStore& store)
    {
        std::map<std::string, std::string> state;
        for (const CaseRecord& c : store.cases()) {
            state["case " + c.id] = nlohmann::json(c.patient).dump() + nlohmann::json(c.flags).dump();
            for (const ScanRecord& s : store.scans(c.id)) {
                state["scan " + c.id + s.id] = nameOf(s.role) + s.ingest.dump() + nlohmann::json(s.series).dump();
                for (const InstanceRecord& i : store.instances(c.id, s.id))
                    state["instance " + i.sop_uid] = i.scan_id + i.file + i.sha256;
            }
        }
        const soci::rowset<soci::row> jobs =
            (store.database().session().prepare << "SELECT case_id, scan_id, state FROM jobs");
        for (const auto& job : jobs)
            state["job " + job.get<std::string>(0) + job.get<std::string>(1)] = job.get<std::string>(2);
        for (const char* part : {"cases", "quarantine", "incoming"})
            addFiles(state, store.folder(), part);
        return state;
    }

    static void append(const std::filesystem::path& file, const std::string& bytes)
    {
        std::ofstream(file, std::ios::binary | std::ios::app) << bytes;
    }

    static SeriesSpec secondSeries(const SeriesSpec& first, const std::string& suffix)
    {
        SeriesSpec spec = first;
        spec.series_uid = first.study_uid + "." + suffix;
        spec.series_number = first.series_number + 1;
        return spec;
    }

private:
    static void addFiles(std::map<std::string, std::string>& state, const std::filesystem::path& store,
                         const char* part)
    {
        std::error_code none_there;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(store / part, none_there))
            if (entry.is_regular_file())
                state["file " + std::filesystem::relative(entry.path(), store).string()] =
                    entry.path().filename() == "scan.json" ? withoutTime(entry.path()) : sha256OfFile(entry.path());
    }
    static std::string withoutTime(const std::filesystem::path& file)
    {
        auto json = nlohmann::json::parse(readFile(file));
        json.erase("created");
        return json.dump();
    }
};

}  // namespace vicon::test
