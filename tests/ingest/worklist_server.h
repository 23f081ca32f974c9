#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <memory>
#include <string>

#include "orthanc.h"

namespace vicon::test {

/// What a department's system has scheduled.
struct Scheduled {
    std::string patient_id = "P1", patient_name = "Doe^Jane", birth_date = "19600101";
    std::string study_uid = "1.2.826.0.1.3680043.10.77.1", accession_number = "A77";
    std::string referring_physician = "Weiss^Anna", procedure_id = "RP1", procedure = "CT colonography";
    std::string reason = "Incomplete colonoscopy";
    std::string modality = "CT", date = "20260102";
};

/// A file as worklist servers serve it.
inline void writeScheduled(const fs::path& file, const Scheduled& about)
{
    DcmFileFormat format;
    DcmDataset& d = *format.getDataset();
    const auto put = [](DcmItem& item, const DcmTagKey& tag, const std::string& value) {
        EXPECT_TRUE(item.putAndInsertString(tag, value.c_str()).good()) << value;
    };
    put(d, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(d, DCM_AccessionNumber, about.accession_number);
    put(d, DCM_PatientName, about.patient_name);
    put(d, DCM_PatientID, about.patient_id);
    put(d, DCM_PatientBirthDate, about.birth_date);
    put(d, DCM_PatientSex, "F");
    put(d, DCM_ReferringPhysicianName, about.referring_physician);
    put(d, DCM_StudyInstanceUID, about.study_uid);
    put(d, DCM_RequestedProcedureID, about.procedure_id);
    put(d, DCM_RequestedProcedureDescription, about.procedure);
    put(d, DCM_ReasonForTheRequestedProcedure, about.reason);
    auto* const step = new DcmItem;  // the data set's
    put(*step, DCM_Modality, about.modality);
    put(*step, DCM_ScheduledStationAETitle, "CT1");
    put(*step, DCM_ScheduledProcedureStepStartDate, about.date);
    put(*step, DCM_ScheduledProcedureStepStartTime, "101000");
    put(*step, DCM_ScheduledProcedureStepDescription, "CT abdomen");
    put(*step, DCM_ScheduledProcedureStepID, "SPS1");
    ASSERT_TRUE(d.insertSequenceItem(DCM_ScheduledProcedureStepSequence, step).good());
    fs::create_directories(file.parent_path());
    ASSERT_TRUE(format.saveFile((file.parent_path() / "part").c_str(), EXS_LittleEndianExplicit).good());
    fs::rename(file.parent_path() / "part", file);
}

/// DCMTK's worklist server, for the length of a test: it serves the files *.wl in FOLDER/RIS.
class WorklistServer {
public:
    explicit WorklistServer(const fs::path& folder) : folder_(folder), port_(freePort())
    {
        fs::create_directories(scheduled());
        std::ofstream(scheduled() / "lockfile");
        process_ = ::fork();
        if (process_ == 0) {
            const std::string log = (folder_ / "log").string(), port = std::to_string(port_);
            if (!std::freopen(log.c_str(), "w", stdout) || !std::freopen(log.c_str(), "a", stderr))
                std::_Exit(126);
            ::execlp("wlmscpfs", "wlmscpfs", "-dfp", folder_.c_str(), port.c_str(), nullptr);
            std::_Exit(127);
        }
    }
    ~WorklistServer()
    {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    WorklistServer(const WorklistServer&) = delete;
    WorklistServer& operator=(const WorklistServer&) = delete;

    fs::path scheduled() const { return folder_ / "RIS"; }
    ingest::Peer peer() const { return {"ris", "127.0.0.1", "RIS", port_}; }
    bool answers() const { return comesToAnswer(peer()); }

private:
    fs::path folder_;
    int port_;
    pid_t process_ = -1;
};

}  // namespace vicon::test
