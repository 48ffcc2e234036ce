// Scales of transfer functions (volume/transfer_function.h): g of a value in the scale's own unit. `scale` is a constant.
float scaledValue(int scale, float value) {
    if (scale == 1) return log2(max(value, 1e-37));
    if (scale == 2) {
        float magnitude = abs(value);
        return magnitude <= 1.0 ? value : sign(value) * (1.0 + log(magnitude));
    }
    return value;
}
