#pragma once

#include <map>
#include <string>
#include <vector>

#include "scan_assembly.h"
#include "study_objects.h"

namespace vicon::ingest {

/// Takes the objects of one study into its case.
class StudyImport {
public:
    explicit StudyImport(const ImportContext& context) : context_(context) {}
    /// @param arrivals of one study, in the order in which they were found
    /// @param notes by Series Instance UID
    void run(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes);

private:
    void describe(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const;
    void addNotes(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const;
    void store(const AssembledScan& scan);
    /// Records a scan that grew or is told of otherwise. @return the flag that its case got; empty for none
    std::string record(const AssembledScan& scan, const std::vector<InstanceRecord>& instances, bool grew,
                       bool new_role);
    void requireNoReaderInput(const AssembledScan& scan) const;
    void tell(const AssembledScan& scan, bool changed) const;
    void removeEmptied() const;

    const ImportContext& context_;
    StoredStudy stored_;
    std::vector<AssembledScan> scans_;
};

}  // namespace vicon::ingest
