"use strict";
// Unpacks plotly.js and draws the figures. On paper they have the width of a page; on the screen
// that of their place. "data-drawn" on the page's root says how many have been drawn.
(async function () {
  const root = document.documentElement;
  const figures = JSON.parse(document.getElementById("figures").textContent);
  if (typeof DecompressionStream === "undefined") {
    document.getElementById("no-figures").hidden = false;
    return;
  }
  const packed = atob(document.getElementById("plotly").textContent.trim());
  const bytes = Uint8Array.from(packed, (character) => character.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const script = document.createElement("script");
  script.textContent = await new Response(unpacked).text();
  document.head.append(script);

  const options = { responsive: true, displaylogo: false };
  const places = figures.map((_, i) => document.getElementById("figure-" + i));
  for (const [i, figure] of figures.entries()) {
    await Plotly.newPlot(places[i], figure.data, figure.layout, options);
    root.dataset.drawn = String(i + 1);
  }

  const paperWidth = 680;
  window.addEventListener("beforeprint", () => {
    for (const place of places) Plotly.relayout(place, { width: paperWidth, autosize: false });
  });
  window.addEventListener("afterprint", () => {
    for (const place of places) Plotly.relayout(place, { width: null, autosize: true });
  });
})();
