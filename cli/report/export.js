// A chart as a file of its own: SVG, or PNG at twice the size. The title and the legend, which are no part of the drawing on
// the page, are added; colours are those that the page shows.

const exported = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "font-family", "font-size", "font-weight", "text-anchor", "opacity"];

const svgElement = (name, attributes, text) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
};

/** Copies the styles of the style sheets into each element. */
function withStyles(original) {
  const copy = original.cloneNode(true);
  const [from, to] = [original, copy].map((root) => [root, ...root.querySelectorAll("*")]);
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    if (style.display === "none" || element.closest(".brush")) to[i].setAttribute("data-gone", "");
    else for (const name of exported) to[i].style.setProperty(name, style.getPropertyValue(name));
  });
  copy.querySelectorAll("[data-gone]").forEach((element) => element.remove());
  return copy;
}

/** The whole picture: background, title, drawing, legend. */
function picture(plot, legend, title) {
  const drawing = withStyles(plot.querySelector("svg"));
  const [width, inner] = ["width", "height"].map((name) => Number(drawing.getAttribute(name)));
  const text = (attributes, content) => svgElement("text", { "font-family": "sans-serif", "font-size": 13, fill: ink("--ink"), ...attributes }, content);
  const keys = [];
  let [x, y] = [12, 34 + inner + 14];
  for (const key of legend.querySelectorAll("button[aria-pressed=true]")) {
    const size = 34 + 7.5 * key.textContent.length;
    if (x > 12 && x + size > width) { x = 12; y += 22; }
    keys.push(svgElement("rect", { x, y: y - 10, width: 11, height: 11, fill: getComputedStyle(key.querySelector("i")).backgroundColor }), text({ x: x + 16, y }, key.textContent));
    x += size;
  }
  const height = y + 14;
  const svg = svgElement("svg", { xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${width} ${height}`, width, height });
  const place = svgElement("g", { transform: "translate(0,34)" });
  place.append(...drawing.childNodes);
  svg.append(svgElement("rect", { width, height, fill: ink("--ground") }), text({ x: 12, y: 22, "font-weight": "bold", "font-size": 15 }, title), place, ...keys);
  return { svg: new XMLSerializer().serializeToString(svg), width, height };
}

function save(blob, name) {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const fileName = (title, ending) => `${title.replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_|_$/g, "").toLowerCase()}.${ending}`;

function saveSvg(plot, legend, title) {
  save(new Blob([picture(plot, legend, title).svg], { type: "image/svg+xml" }), fileName(title, "svg"));
}

function savePng(plot, legend, title) {
  const { svg, width, height } = picture(plot, legend, title);
  const image = new Image();
  image.onload = () => {
    const canvas = make("canvas", { width: 2 * width, height: 2 * height });
    const context = canvas.getContext("2d");
    context.scale(2, 2);
    context.drawImage(image, 0, 0);
    canvas.toBlob((blob) => save(blob, fileName(title, "png")), "image/png");
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
}
