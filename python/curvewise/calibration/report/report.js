"use strict";
// Unpacks plotly.js and draws the figures. On paper they have the width of a page, or half of it
// where there are several; on the screen that of their place. "data-drawn" on the page's root says how many have been drawn.
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

  // What chooses points is of no use here, and would hide the titles on narrow screens.
  const modeBarButtonsToRemove = ["select2d", "lasso2d", "autoScale2d"];
  const options = { responsive: true, displaylogo: false, modeBarButtonsToRemove };
  const places = figures.map((_, i) => document.getElementById("figure-" + i));
  for (const [i, figure] of figures.entries()) {
    await Plotly.newPlot(places[i], figure.data, figure.layout, options);
    root.dataset.drawn = String(i + 1);
  }

  window.addEventListener("beforeprint", () => {
    for (const place of places) {
      const isAlone = place.parentElement.children.length === 1;
      const size = { width: isAlone ? 700 : 345, height: 300, autosize: false };
      resize(place, { ...size, "font.size": 10, "title.font.size": 12 });
    }
  });
  window.addEventListener("afterprint", () => {
    for (const [i, place] of places.entries()) {
      const { height, font, title } = figures[i].layout;
      const size = { width: null, height, autosize: true };
      resize(place, { ...size, "font.size": font.size, "title.font.size": title?.font.size });
    }
  });

  function resize(place, size) {
    place.style.height = size.height + "px";
    Plotly.relayout(place, size);
  }
})();
