// Cells of the volume that answer for a stretch of a ray (stages/occupancy.h).
uniform vec3 cellsPerTexture;
uniform ivec3 lastCell;
uniform vec3 periodicAxes; // 1 on axes that wrap

ivec3 cellAt(vec3 position) {
    vec3 wrapped = position - periodicAxes * floor(position);
    return clamp(ivec3(wrapped * cellsPerTexture), ivec3(0), lastCell);
}
