#include "vicon/ingest/anonymise.h"

#include "anonymous_object.h"
#include "load_data.h"
#include "stored_files.h"
#include "text.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/uid.h"
#include "vicon/dicom/dicom_setup.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Kept by the store, so that a case that grew can be written again.
std::string keyOf(const CaseStore& store)
{
    const fs::path file = store.folder() / "anonymous.key";
    if (!fs::exists(file))
        replaceFile(file, sha256(randomUid() + randomUid()));
    return readFile(file);
}

/// What tells a patient from others, also from those to whom another hospital, or a slip, gave the same ID. Without an
/// ID each study is a patient's of its own.
std::string whoIs(const CaseRecord& record)
{
    const Patient& patient = record.patient;
    if (patient.id.empty())
        return record.study.uid;
    return patient.id + "\n" + foldedForComparison(patient.name) + "\n" + patient.birth_date;
}

/// Returns why it was not written; empty where it was.
std::string writeOne(const fs::path& from, const fs::path& folder, const Pseudonyms& pseudonyms, const NewUids& uids)
{
    DcmFileFormat format;
    if (loadData(format, from).bad())
        throw Error(ErrorCode::bad_input, "an object cannot be read", from.filename().string(),
                    "see 'vicon doctor' and restore it from a backup");
    DcmDataset& dataset = *format.getDataset();
    if (std::string why = whyNotAnonymous(dataset); !why.empty())
        return why;
    makeAnonymous(dataset, pseudonyms, uids);
    const E_TransferSyntax syntax = dataset.getOriginalXfer();
    DcmFileFormat fresh(format.getAndRemoveDataset(), OFFalse);  // neither the old header nor its preamble
    makePrivateFolder(folder);
    replaceFile(folder / fileNameFor(pseudonyms.uid(uids.object)), [&](const fs::path& file) {
        const OFCondition saved = fresh.saveFile(file.c_str(), syntax, EET_ExplicitLength, EGL_withoutGL,
                                                 EPD_withoutPadding, 0, 0, EWM_createNewMeta);
        if (saved.bad())
            throw Error(ErrorCode::store, std::string("an object cannot be written (") + saved.text() + ")",
                        folder.string(), "free some space on this disk and try again");
    });
    return {};
}

Anonymised writeCase(CaseStore& store, const CaseRecord& record, const fs::path& out, Progress& progress)
{
    const Pseudonyms pseudonyms(keyOf(store), whoIs(record));
    Anonymised made;
    int folders = 0;
    for (const ScanRecord& scan : store.scans(record.id)) {
        const fs::path folder = out / std::to_string(++folders);
        const auto instances = store.instances(record.id, scan.id);
        for (const InstanceRecord& instance : instances) {
            progress.check();
            progress.report(double(made.written) / double(instances.size()), "series " + std::to_string(folders));
            const std::string why = writeOne(store.scanFolder(record.id, scan.id) / "dicom" / instance.file, folder,
                                             pseudonyms, {record.study.uid, scan.series.uid, instance.sop_uid});
            if (why.empty())
                ++made.written;
            else
                ++made.left_out[why];
        }
    }
    return made;
}

}  // namespace

Anonymised anonymise(CaseStore& store, const std::string& case_id, const fs::path& given, Progress& progress)
{
    setUpDicom();
    const CaseRecord record = store.requireCase(case_id);
    const fs::path out = (fs::absolute(given) / "").lexically_normal().parent_path();  // without a slash at its end
    std::error_code none;
    if (fs::exists(out) && !fs::is_empty(out, none))
        throw Error(ErrorCode::wrong_use, "the folder is not empty", out.string(), "name one that is not there");
    const fs::path making = out.parent_path() / (std::string(kTemporaryPrefix) + out.filename().string());
    fs::remove_all(making, none);
    try {
        makePrivateFolder(making);
        Anonymised made = writeCase(store, record, making, progress);
        fs::remove(out, none);
        fs::rename(making, out);
        store.audit(AuditEvent::case_written_without_names, case_id, "", std::to_string(made.written) + " objects");
        return made;
    } catch (const fs::filesystem_error& e) {
        fs::remove_all(making, none);
        throw Error(ErrorCode::store, "the folder cannot be written (" + e.code().message() + ")", out.string(),
                    "name another one");
    } catch (...) {
        fs::remove_all(making, none);
        throw;
    }
}

}  // namespace vicon::ingest
