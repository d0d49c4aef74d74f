// A file that the browser keeps: a picture or a film, named after the page.
function keep(blob, ending) {
  const link = element("a", { href: URL.createObjectURL(blob), download: `${document.title.split(":")[0].replace(/[^\w-]+/g, "-")}.${ending}` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
