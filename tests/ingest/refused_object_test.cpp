// What cannot be kept is refused with the status that says why, and nothing of it stays.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dimse.h>

#include "dicom_writer.h"
#include "running_receiver.h"
#include "store_fixture.h"

namespace vicon::test {
namespace {

class RefusedObject : public StoreFixture {
protected:
    const fs::path incoming = store.folder() / "incoming";
    std::size_t filesIn(const fs::path& where) const
    {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(where))
            count += entry.is_regular_file() && entry.path().extension() == ".dcm" ? 1 : 0;
        return count;
    }
};

/// Sends an object under another name than its own.
Uint16 storeUnder(int port, const fs::path& file, const std::string& sop_class, const std::string& sop_uid)
{
    T_ASC_Network* network = nullptr;
    T_ASC_Parameters* parameters = nullptr;
    T_ASC_Association* association = nullptr;
    EXPECT_TRUE(ASC_initializeNetwork(NET_REQUESTOR, 0, 30, &network).good());
    EXPECT_TRUE(ASC_createAssociationParameters(&parameters, ASC_DEFAULTMAXPDU).good());
    ASC_setAPTitles(parameters, "SENDER", "VICON", nullptr);
    ASC_setPresentationAddresses(parameters, "localhost", ("localhost:" + std::to_string(port)).c_str());
    const char* syntaxes[] = {UID_LittleEndianExplicitTransferSyntax};
    ASC_addPresentationContext(parameters, 1, sop_class.c_str(), syntaxes, 1);
    EXPECT_TRUE(ASC_requestAssociation(network, parameters, &association).good());
    T_DIMSE_C_StoreRQ request{};
    request.MessageID = 1;
    request.DataSetType = DIMSE_DATASET_PRESENT;
    request.Priority = DIMSE_PRIORITY_MEDIUM;
    OFStandard::strlcpy(request.AffectedSOPClassUID, sop_class.c_str(), sizeof request.AffectedSOPClassUID);
    OFStandard::strlcpy(request.AffectedSOPInstanceUID, sop_uid.c_str(), sizeof request.AffectedSOPInstanceUID);
    T_DIMSE_C_StoreRSP response{};
    DcmDataset* details = nullptr;
    EXPECT_TRUE(DIMSE_storeUser(association, 1, &request, file.c_str(), nullptr, nullptr, nullptr, DIMSE_BLOCKING, 0,
                                &response, &details)
                    .good());
    delete details;
    ASC_releaseAssociation(association);
    ASC_destroyAssociation(&association);
    ASC_dropNetwork(&network);
    return response.DimseStatus;
}

TEST_F(RefusedObject, ThatIsNotWhatItsSenderSaysIsRefusedAsThat)
{
    const SeriesSpec spec;
    const fs::path file = writeSeries(folder / "in", spec, {0}).at(0);
    RunningReceiver receiver(incoming, {});
    constexpr Uint16 kMismatch = 0xa900;
    EXPECT_EQ(storeUnder(receiver.port(), file, UID_CTImageStorage, "1.2.3"), kMismatch);
    EXPECT_TRUE(receiver.tells("its SOP Instance UID is not what was announced"));
    EXPECT_EQ(storeUnder(receiver.port(), file, UID_MRImageStorage, spec.sopUid(0)), kMismatch);
    EXPECT_TRUE(receiver.tells("its SOP Class UID is not what was announced"));
    EXPECT_EQ(storeUnder(receiver.port(), file, UID_CTImageStorage, spec.sopUid(0)), 0);
    EXPECT_EQ(receiver.waitFor(1).size(), 1u) << "that one alone";
    receiver.stop();
    EXPECT_EQ(filesIn(store.folder()), 0u);
}

TEST_F(RefusedObject, ThatCannotBeUnderstoodIsRefusedAsThat)
{
    const auto files = writeSeries(folder / "in", {});
    DcmFileFormat deep;
    ASSERT_TRUE(deep.loadFile(files[3].c_str()).good());
    DcmItem* item = deep.getDataset();
    for (int depth = 0; depth < 100; ++depth) {
        auto* const inner = new DcmItem;  // the data set's
        ASSERT_TRUE(item->insertSequenceItem(DCM_ContentSequence, inner).good());
        item = inner;
    }
    ASSERT_TRUE(deep.saveFile(files[3].c_str(), EXS_LittleEndianExplicit).good());
    DcmFileFormat rich;
    ASSERT_TRUE(rich.loadFile(files[5].c_str()).good());
    for (int n = 0; n < 20000; ++n)
        rich.getDataset()->insert(new DcmLongString(DcmTag(0x29, Uint16(0x1010 + n), EVR_LO)));
    ASSERT_TRUE(rich.saveFile(files[5].c_str(), EXS_LittleEndianExplicit).good());
    RunningReceiver receiver(incoming, {});
    const auto result = ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(result.sent, 10);
    ASSERT_EQ(result.failures.size(), 2u);
    EXPECT_NE(result.failures[0].reason.find("c000"), std::string::npos) << result.failures[0].reason;
    EXPECT_TRUE(result.failures[0].for_good);
    EXPECT_TRUE(receiver.tells("its sequences are nested deeper than 64"));
    EXPECT_TRUE(receiver.tells("has more than 10000 elements"));
    EXPECT_EQ(receiver.waitFor(10).size(), 10u);
}

}  // namespace
}  // namespace vicon::test
