// Decodes the arrays of numbers in the page: base64, little-endian.

function decodedBytes(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}
const float64 = (text) => new Float64Array(decodedBytes(text));
const float32 = (text) => new Float32Array(decodedBytes(text));
const int32 = (text) => new Int32Array(decodedBytes(text));
const int16 = (text) => new Int16Array(decodedBytes(text));
