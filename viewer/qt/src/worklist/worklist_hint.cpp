#include "worklist/worklist_hint.h"

#include <QObject>

#include "vicon/viewer/qt/reading_room.h"

namespace vicon::viewer {

QString hintOfEmptyStore(const ReadingServices& services)
{
    const QString store = QString::fromStdString(services.store.folder.string());
    return QObject::tr(
               "There is no case yet in %1.\n\nTo bring studies in:\n\nvicon import FOLDER --store %1\nvicon work "
               "--until-idle --store %1\n\nor send them from the PACS to %2, while this runs:\n\nvicon receive --store "
               "%1\n\nThe list renews itself.")
        .arg(store, QString::fromStdString(services.receiver));
}

QString hintOfNothingFound(const QString& words, const QString& state)
{
    const QString none = words.isEmpty() ? QObject::tr("No case is \"%1\" now.").arg(state)
                         : state.isEmpty()
                             ? QObject::tr("No case is found by \"%1\".").arg(words)
                             : QObject::tr("No case that is \"%1\" is found by \"%2\".").arg(state, words);
    return none + QObject::tr(
                      "\n\nWhat is typed begins parts of the name, ID, accession number or date. Clear it (Ctrl+F), or "
                      "choose \"all\" on the right.");
}

}  // namespace vicon::viewer
