// Cells of the volume that answer for a stretch of a ray (stages/occupancy.h).
uniform vec3 cellsPerTexture;
uniform ivec3 lastCell;
uniform vec3 periodicAxes; // 1 on axes that wrap

ivec3 cellAt(vec3 position) {
    vec3 wrapped = position - periodicAxes * floor(position);
    return clamp(ivec3(wrapped * cellsPerTexture), ivec3(0), lastCell);
}

uniform int cellSamples; // per axis of a cell

// From a stretch of a ray whose middle lies in a cell with this mark to the next that may show something, in
// stretches; 0: this one may. Marks are distances to the nearest cell that shows something (emptyDistances in
// stages/occupancy.h).
int stretchesAhead(uint mark, float stretchVoxels) {
    int distance = int(mark & 15u);
    return distance == 0 ? 0 : 1 + int(float((distance - 1) * cellSamples) / stretchVoxels);
}

// How many samples one stands for in a stretch that may show something (stages/sample_strides.h).
int strideOf(uint mark) { return 1 << (mark >> 4); }
