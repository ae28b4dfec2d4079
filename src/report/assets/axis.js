// An axis of a panel: from values, SI, to fractions of it and back, with its values in words.
class Axis {
  constructor(data) {
    Object.assign(this, data);
    [this.first, this.last] = data.range.map((v) => this.scaled(v));
  }

  scaled(value) {
    return this.log ? Math.log(value) : value;
  }

  fraction(value) {
    return (this.scaled(value) - this.first) / (this.last - this.first);
  }

  value(fraction) {
    const scaled = this.first + fraction * (this.last - this.first);
    return this.log ? Math.exp(scaled) : scaled;
  }

  // A value in its units, as in "1760 kN m/rad (1.30·10⁶ lbf ft/rad)".
  written(value) {
    const texts = this.units.map(([label, factor]) => {
      const space = label === "" || label === "°" ? "" : " ";
      return written(value / factor, 4) + space + label;
    });
    return texts.length > 1 ? `${texts[0]} (${texts[1]})` : texts[0];
  }

  // Round values of a unit within a part of the axis, SI.
  ticks([from, to], factor) {
    const [low, high] = [this.value(from) / factor, this.value(to) / factor];
    const found = [];
    if (this.log && high / low > 8) {
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
        for (const digit of [1, 2, 5]) found.push(digit * 10 ** power);
      }
    } else {
      const size = 10 ** Math.floor(Math.log10((high - low) / 4));
      const step = [1, 2, 5, 10].find((s) => s * size >= (high - low) / 6) * size;
      for (let k = Math.ceil(low / step); k * step <= high; k += 1) found.push(k * step);
    }
    return found
      .filter((v) => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9))
      .map((v) => ({ value: v * factor, label: tick(v) }));
  }
}
