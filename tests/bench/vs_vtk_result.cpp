#include "bench/vs_vtk_result.h"

#include "bench/json_text.h"
#include "bench/volume_bench.h"

namespace voxsheet::bench {

std::string jsonOf(const VsVtkResult& result) {
    const double ours = median(result.voxsheetMs);
    const double gpu = median(result.vtkGpuMs);
    std::optional<double> cpu, cpuRatio, cpuPsnr;
    if (!result.vtkCpuMs.empty()) cpu = median(result.vtkCpuMs);
    if (cpu) cpuRatio = *cpu / ours;
    if (result.vtkCpu) cpuPsnr = result.vtkCpu->psnr;
    return jsonObject({{"name", jsonString(result.name)},
                       {"voxsheet_ms", jsonNumber(ours)},
                       {"vtk_gpu_ms", jsonNumber(gpu)},
                       {"vtk_cpu_ms", jsonNumber(cpu)},
                       {"ratio_vtk_gpu", jsonNumber(gpu / ours)},
                       {"ratio_vtk_cpu", jsonNumber(cpuRatio)},
                       {"voxsheet_psnr", jsonNumber(result.voxsheet.psnr)},
                       {"vtk_gpu_psnr", jsonNumber(result.vtkGpu.psnr)},
                       {"vtk_cpu_psnr", jsonNumber(cpuPsnr)},
                       {"voxsheet_p999", jsonNumber(result.voxsheet.p999)},
                       {"vtk_gpu_p999", jsonNumber(result.vtkGpu.p999)}});
}

} // namespace voxsheet::bench
