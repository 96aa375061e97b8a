// Draws the figures of a report, one after the other so that the page stays alive; colours for light,
// dark and paper.
(function () {
  "use strict";
  const kLight = {
    blue: "#0068b0", orange: "#d07a00", green: "#008a66", red: "#cc4400", purple: "#a8508c",
    sky: "#2f97d0", brown: "#7a5230", gray: "#6b7580", ink: "#1b1f24", muted: "#5b6570",
    faint: "#dfe3e8", paper: "#ffffff",
    sequential: [[0, "#f4f6f8"], [0.25, "#c5dbec"], [0.5, "#74b0d8"], [0.75, "#2478b5"], [1, "#08365f"]],
  };
  const kDark = {
    blue: "#5cb0f5", orange: "#f5b041", green: "#2fc79d", red: "#ff7f50", purple: "#dd94c4",
    sky: "#8fd3f7", brown: "#c79b72", gray: "#98a2ad", ink: "#e6e9ed", muted: "#9aa4af",
    faint: "#2c3239", paper: "#14171b",
    sequential: [[0, "#1a1f25"], [0.25, "#1d4262"], [0.5, "#2a76ad"], [0.75, "#6cb4ea"], [1, "#e2f1fc"]],
  };
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let paper = false;

  function paint(value, colors) {
    if (typeof value === "string" && value.charAt(0) === "@") {
      const [name, alpha] = value.slice(1).split("/");
      const color = colors[name];
      if (color === undefined) return value;
      if (alpha === undefined || typeof color !== "string") return color;
      return color + Math.round(2.55 * alpha).toString(16).padStart(2, "0");
    }
    if (Array.isArray(value)) return typeof value[0] === "number" ? value : value.map((v) => paint(v, colors));
    if (value && typeof value === "object") {
      return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, paint(v, colors)]));
    }
    return value;
  }

  function withDefaults(layout, colors, width) {
    const axis = {
      gridcolor: colors.faint, zerolinecolor: colors.faint, linecolor: colors.muted,
      tickcolor: colors.muted, ticks: "outside", ticklen: 4, showline: true, mirror: true,
      title: { standoff: 8 }, exponentformat: "SI",
    };
    const out = Object.assign({
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", hovermode: "closest",
      hoverlabel: { bgcolor: colors.paper, font: { color: colors.ink } },
      font: { family: "system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif", size: 12, color: colors.ink },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: colors.muted, activecolor: colors.blue },
      legend: { orientation: "h", x: 0, xanchor: "left", yref: "container", y: 0, yanchor: "bottom", font: { size: 11 } },
    }, layout);
    for (const key of Object.keys(out)) {
      if (!/^[xy]axis\d*$/.test(key)) continue;
      const title = Object.assign({}, axis.title, out[key].title);
      const own = key.charAt(0) === "y" ? { automargin: true } : {};
      out[key] = Object.assign({}, axis, own, out[key], { title: title });
    }
    if (width) out.width = width;
    return out;
  }

  const config = {
    responsive: true, displaylogo: false,
    // A report stays where it is: no button may offer to upload its data.
    showSendToCloud: false, showEditInChartStudio: false,
    modeBarButtonsToRemove: ["sendChartToCloud", "sendDataToCloud", "select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg", filename: document.title },
  };
  const drawn = new Set();

  function draw(figure) {
    const div = figure.querySelector(".plot");
    const spec = JSON.parse(figure.querySelector("script").textContent);
    const colors = paper || !dark.matches ? kLight : kDark;
    // Paper has no window to fill: the width of an A4 page's text.
    const width = paper ? Math.min(680, parseFloat(div.style.maxWidth) || 680) : 0;
    drawn.add(figure);
    const plot = Plotly.react(div, paint(spec.data, colors), withDefaults(paint(spec.layout, colors), colors, width), config);
    const frames = spec.layout.meta && spec.layout.meta.frames; // of a figure whose buttons animate it
    if (frames && !div._hasFrames) {
      div._hasFrames = true;
      return plot.then(() => Plotly.addFrames(div, frames));
    }
    return plot;
  }

  const figures = Array.from(document.querySelectorAll("figure"));
  function drawFrom(k) {
    if (k >= figures.length) return;
    if (!drawn.has(figures[k])) draw(figures[k]);
    window.setTimeout(drawFrom, 0, k + 1);
  }
  drawFrom(0);
  dark.addEventListener("change", () => drawn.forEach(draw));
  window.addEventListener("beforeprint", () => {
    paper = true;
    document.querySelectorAll("details").forEach((d) => { d.open = true; });
    figures.forEach(draw);
  });
  window.addEventListener("afterprint", () => {
    paper = false;
    figures.forEach(draw);
  });

  // A table that does not fit says so.
  const tables = Array.from(document.querySelectorAll(".table"));
  function markWide() {
    tables.forEach((t) => t.classList.toggle("scrolls", t.scrollWidth > t.clientWidth + 1));
  }
  window.addEventListener("resize", markWide);
  markWide();

  // The contents show where the reader is: the last heading above the upper third of the window.
  const links = new Map(Array.from(document.querySelectorAll("nav a"), (a) => [a.hash.slice(1), a]));
  const headings = Array.from(document.querySelectorAll("main h2, main h3"));
  function mark() {
    let here = headings[0];
    for (const h of headings) {
      if (h.getBoundingClientRect().top < window.innerHeight / 3) here = h;
    }
    links.forEach((a, id) => a.classList.toggle("here", here !== undefined && id === here.id));
  }
  window.addEventListener("scroll", mark, { passive: true });
  mark();
})();
