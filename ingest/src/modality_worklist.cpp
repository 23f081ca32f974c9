#include "vicon/ingest/modality_worklist.h"

#include <algorithm>
#include <memory>
#include <tuple>

#include "dataset.h"
#include "find.h"

namespace vicon::ingest {
namespace {

constexpr FindModel kModalityWorklist{UID_FINDModalityWorklistInformationModel, "the peer has no modality worklist"};

ScheduledStep stepFrom(DcmDataset& match)
{
    const Dataset d(match);
    ScheduledStep step;
    step.patient = {d.text(DCM_PatientID), d.personName(DCM_PatientName), d.text(DCM_PatientBirthDate),
                    d.text(DCM_PatientSex)};
    step.study_uid = d.text(DCM_StudyInstanceUID);
    step.accession_number = d.text(DCM_AccessionNumber);
    step.referring_physician = d.personName(DCM_ReferringPhysicianName);
    step.procedure_id = d.text(DCM_RequestedProcedureID);
    step.procedure = d.text(DCM_RequestedProcedureDescription);
    step.reason = d.text(DCM_ReasonForTheRequestedProcedure);
    if (const auto scheduled = d.item(DCM_ScheduledProcedureStepSequence)) {
        step.modality = scheduled->text(DCM_Modality);
        step.station = scheduled->text(DCM_ScheduledStationAETitle);
        step.date = scheduled->text(DCM_ScheduledProcedureStepStartDate);
        step.time = scheduled->text(DCM_ScheduledProcedureStepStartTime);
        step.description = scheduled->text(DCM_ScheduledProcedureStepDescription);
    }
    return step;
}

}  // namespace

std::vector<ScheduledStep> findScheduledSteps(const Peer& peer, const StudyQuery& query,
                                              const std::string& our_ae_title, Progress& progress)
{
    DcmDataset keys;
    put(keys, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(keys, DCM_PatientID, query.patient_id);
    put(keys, DCM_PatientName, query.patient_name);
    put(keys, DCM_AccessionNumber, query.accession_number);
    put(keys, DCM_StudyInstanceUID, query.study_uid);
    askFor(keys, {DCM_PatientBirthDate, DCM_PatientSex, DCM_ReferringPhysicianName, DCM_RequestedProcedureID,
                  DCM_RequestedProcedureDescription, DCM_ReasonForTheRequestedProcedure});
    auto scheduled = std::make_unique<DcmItem>();
    put(*scheduled, DCM_Modality, query.modality);
    put(*scheduled, DCM_ScheduledProcedureStepStartDate, dicomDates(query.dates));
    askFor(*scheduled, {DCM_ScheduledStationAETitle, DCM_ScheduledProcedureStepStartTime,
                        DCM_ScheduledProcedureStepDescription, DCM_ScheduledProcedureStepID});
    if (keys.insertSequenceItem(DCM_ScheduledProcedureStepSequence, scheduled.get()).good())
        (void)scheduled.release();  // the data set has it now
    std::vector<ScheduledStep> steps;
    find(peer, kModalityWorklist, keys, our_ae_title, progress,
         [&](DcmDataset& match) { steps.push_back(stepFrom(match)); });
    std::sort(steps.begin(), steps.end(), [](const ScheduledStep& a, const ScheduledStep& b) {
        return std::tie(a.date, a.time, a.accession_number) < std::tie(b.date, b.time, b.accession_number);
    });
    return steps;
}

}  // namespace vicon::ingest
