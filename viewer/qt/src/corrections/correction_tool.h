#pragma once

#include "corrections/corrector.h"
#include "reading/reading_tool.h"

namespace vicon::viewer {

class ColonPanel;
class ReadingLayout;

/// Corrections of what the pipeline took for the colon, by a click; its bridges, to be judged.
class CorrectionTool : public ReadingTool {
    Q_OBJECT
public:
    CorrectionTool(Reading& reading, const ReadingServices& services, const std::string& case_id);

    void addTo(ReadingLayout& layout) override;
    void useWords(const OrganWords& words) override;
    void scanOpened(const Arrival& arrival) override;
    bool act(const ClickMeaning& meaning, const ClickedPoint& point) override;
    std::optional<StepNumber> toUndo() const override { return corrector_.toUndo(); }
    std::optional<StepNumber> toRedo() const override { return corrector_.toRedo(); }
    void undo() override { corrector_.undo(); }
    void redo() override { corrector_.redo(); }
    bool redoesScan() const override { return corrector_.busy(); }
    void stop() override { corrector_.stop(); }

private:
    /// What is being done again for this reader.
    struct Corrected {
        std::string scan_id;
        Correction kind = Correction::add;
        Point3 at_mm;
    };
    void connectCorrector();
    void connectPanel();
    void start(Correction kind);
    void correct(const ClickedPoint& point, Correction kind);
    void scanRedone(const QString& scan_id);
    void otherScanRedone(const std::string& scan_id);
    void sayWhatIsNotAdded();

    ReadingLayout* layout_ = nullptr;
    ColonPanel* panel_;
    Corrector corrector_;
    std::optional<Corrected> corrected_;
};

}  // namespace vicon::viewer
