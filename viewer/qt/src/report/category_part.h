#pragma once

#include <QWidget>
#include <optional>
#include <string>
#include <vector>

class QLabel;
class QLineEdit;

namespace vicon::viewer {

class FormChoice;

/// A category: what is proposed and why, what the reader chose, and the reason where that is another one.
class CategoryPart : public QWidget {
    Q_OBJECT
public:
    /// By their names.
    struct State {
        std::optional<std::string> proposed, chosen;
        std::string reason;  ///< of the proposal, in words
        std::string why;     ///< the reader's
    };
    /// @param name of its controls, with "Choice", "Reason" and "Why" behind it
    CategoryPart(const std::string& name, const QString& title, const std::vector<std::string>& categories,
                 QWidget* parent);

    void show(const State& state);

signals:
    /// Where it is not the proposed one, only with a reason.
    void chosen(const std::optional<std::string>& category, const std::string& why);

private:
    bool needsWhy() const;
    void choose();
    void showWhy();

    State shown_;
    FormChoice* choice_;
    QLabel* reason_;
    QLineEdit* why_;
};

}  // namespace vicon::viewer
