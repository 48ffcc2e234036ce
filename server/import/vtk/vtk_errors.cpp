#include "import/vtk/vtk_errors.h"

#include "import/formats/input_file.h"
#include "import/formats/number_text.h"

#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace voxsheet::import {

namespace {

class CollectingWindow : public vtkOutputWindow {
public:
    static CollectingWindow* New();
    vtkTypeMacro(CollectingWindow, vtkOutputWindow);

    void DisplayErrorText(const char* text) override {
        if (first.empty()) first = text;
    }
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}
    void DisplayText(const char*) override {}

    std::string first;
};
vtkStandardNewMacro(CollectingWindow);

} // namespace

VtkErrorCollector::VtkErrorCollector() {
    const auto window = vtkSmartPointer<CollectingWindow>::New();
    vtkOutputWindow::SetInstance(window);
}

VtkErrorCollector::~VtkErrorCollector() { vtkOutputWindow::SetInstance(nullptr); }

std::string VtkErrorCollector::firstError() const {
    const auto* window = CollectingWindow::SafeDownCast(vtkOutputWindow::GetInstance());
    if (!window) return {};
    // "ERROR: In FILE, line N\nCLASS (ADDRESS): MESSAGE\n\n"
    auto text = window->first;
    if (const auto message = text.find("): "); message != std::string::npos) text = text.substr(message + 3);
    return printable(trimmed(text));
}

} // namespace voxsheet::import
