#include "object_writing.h"
#include "vicon/core/error.h"

namespace vicon::report {

/// PS3.3 A.45.1, C.24.
ReportObject writeEncapsulatedPdf(const ObjectContent& content, const std::filesystem::path& folder)
{
    DcmFileFormat format;
    DcmDataset& d = *format.getDataset();
    const std::string title = std::string(examinationOf(quantityOf(content.read))) + " report";
    const ObjectName name{ObjectKind::pdf, "DOC", title};
    put(d, DCM_SOPClassUID, UID_EncapsulatedPDFStorage);
    putCommon(d, content, name);
    put(d, DCM_ConversionType, "WSD");
    put(d, DCM_AcquisitionDateTime, "");
    put(d, DCM_BurnedInAnnotation, "YES");
    put(d, DCM_RecognizableVisualFeatures, "NO");
    put(d, DCM_DocumentTitle, title);
    put(d, DCM_VerificationFlag, content.version.isSigned() ? "VERIFIED" : "UNVERIFIED");
    putCode(d, DCM_ConceptNameCodeSequence, "11528-7", "LN", "Radiology Report");
    put(d, DCM_MIMETypeOfEncapsulatedDocument, "application/pdf");
    std::string pdf(content.pdf);
    d.putAndInsertUint32(DCM_EncapsulatedDocumentLength, Uint32(pdf.size()));
    if (pdf.size() % 2 != 0)
        pdf += '\0';  // a value has an even length; the true one is said above
    const OFCondition put_in = d.putAndInsertUint8Array(
        DCM_EncapsulatedDocument, reinterpret_cast<const Uint8*>(pdf.data()), static_cast<unsigned long>(pdf.size()));
    if (put_in.bad())
        throw Error(ErrorCode::no_memory, "the PDF does not go into an object", put_in.text());
    return save(format, content, name, folder);
}

}  // namespace vicon::report
